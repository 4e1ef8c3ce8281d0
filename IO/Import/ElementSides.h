// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** What the elements of a file are, as far as the numbers of their sides tell. */
struct ElementKind
{
  std::uint8_t dimension = 0;
  bool isShell = false; ///< a surface in space, whose sides 1 and 2 are its faces
  bool operator==(const ElementKind&) const = default;
};

/** A side of an element, as files name it by a number of their own. */
struct ElementSide
{
  bool isWhole = false; ///< the element itself, seen from either side
  int dimension = 0;
  std::span<const std::uint8_t> corners = {}; ///< of the element; empty: it has no such side
};

/** Stands after the corners of a side that has fewer than others of its element. */
inline constexpr std::uint8_t NoCorner = 9;

/** The corners of side `number`, from 0; empty: there is none. */
template <std::size_t Sides, std::size_t Corners>
std::span<const std::uint8_t> sideOf(
  const std::array<std::array<std::uint8_t, Corners>, Sides>& sides, std::uint32_t number)
{
  if (number >= Sides)
  {
    return {};
  }
  const std::span<const std::uint8_t> all = sides[number];
  return all.first(static_cast<std::size_t>(std::ranges::find(all, NoCorner) - all.begin()));
}

/** Edge `number`, from 0, of a polygon of three or four corners; empty: there is none. */
inline std::span<const std::uint8_t> edgeOf(std::size_t corners, std::uint32_t number)
{
  static constexpr std::array<std::array<std::uint8_t, 2>, 3> Triangle{ { { 0, 1 }, { 1, 2 },
    { 2, 0 } } };
  static constexpr std::array<std::array<std::uint8_t, 2>, 4> Quadrilateral{ { { 0, 1 }, { 1, 2 },
    { 2, 3 }, { 3, 0 } } };
  return corners == 3 ? sideOf(Triangle, number) : sideOf(Quadrilateral, number);
}

} // namespace smg
