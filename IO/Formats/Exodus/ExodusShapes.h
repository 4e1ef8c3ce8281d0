// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/ElementSides.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace smg
{

/** The shape of the elements of a block of an Exodus file. */
struct ExodusShape : ElementKind
{
  std::uint8_t corners = 0; ///< the first of its nodes
};

/** The shape of elements of this type, as TETRA or HEX8, with so many nodes in a space of so many
 * dimensions; none: they have no cells. */
std::optional<ExodusShape> exodusShape(
  std::string_view type, std::int64_t nodes, std::int64_t dimensions);

/** Side `number`, from 1 on, of elements of this kind with so many corners. */
ElementSide exodusSide(ElementKind kind, std::size_t corners, std::uint32_t number);

} // namespace smg
