// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace smg
{

/** The shape of the elements of a block of an Exodus file. */
struct ExodusShape
{
  std::uint8_t dimension = 0;
  std::uint8_t corners = 0; ///< the first of its nodes
  bool isShell = false;     ///< a surface in space, whose sides 1 and 2 are its faces

  /** As one number, for ListedElements. */
  int kind() const { return this->dimension + (this->isShell ? 4 : 0); }
};

/** The shape of elements of this type, as TETRA or HEX8, with so many nodes in a space of so many
 * dimensions; none: they have no cells. */
std::optional<ExodusShape> exodusShape(
  std::string_view type, std::int64_t nodes, std::int64_t dimensions);

/** A side of an element. */
struct ExodusSide
{
  bool isWhole = false; ///< the element itself, seen from either side
  int dimension = 0;
  std::span<const std::uint8_t> corners = {}; ///< of the element; empty: it has no such side
};

/** Side `number`, from 1 on, of elements of this kind with so many corners. */
ExodusSide exodusSide(int kind, std::size_t corners, std::uint32_t number);

} // namespace smg
