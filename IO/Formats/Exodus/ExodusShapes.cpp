// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Exodus/ExodusShapes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string>

namespace smg
{
namespace
{

constexpr std::uint8_t NoCorner = 9; // after the corners of a smaller side

template <std::size_t Sides, std::size_t Corners>
std::span<const std::uint8_t> sideAt(
  const std::array<std::array<std::uint8_t, Corners>, Sides>& sides, std::uint32_t number)
{
  if (number < 1 || number > Sides)
  {
    return {};
  }
  const std::span<const std::uint8_t> all = sides[number - 1];
  return all.first(static_cast<std::size_t>(std::ranges::find(all, NoCorner) - all.begin()));
}

std::span<const std::uint8_t> exodusFace(std::size_t corners, std::uint32_t number)
{
  static constexpr std::array<std::array<std::uint8_t, 3>, 4> Tetrahedron{ { { 0, 1, 3 },
    { 1, 2, 3 }, { 0, 3, 2 }, { 0, 2, 1 } } };
  static constexpr std::array<std::array<std::uint8_t, 4>, 6> Hexahedron{ { { 0, 1, 5, 4 },
    { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 0, 4, 7, 3 }, { 0, 3, 2, 1 }, { 4, 5, 6, 7 } } };
  static constexpr std::array<std::array<std::uint8_t, 4>, 5> Wedge{ { { 0, 1, 4, 3 },
    { 1, 2, 5, 4 }, { 0, 3, 5, 2 }, { 0, 2, 1, 9 }, { 3, 4, 5, 9 } } };
  static constexpr std::array<std::array<std::uint8_t, 4>, 5> Pyramid{ { { 0, 1, 4, 9 },
    { 1, 2, 4, 9 }, { 2, 3, 4, 9 }, { 0, 4, 3, 9 }, { 0, 3, 2, 1 } } };
  return corners == 4   ? sideAt(Tetrahedron, number)
         : corners == 5 ? sideAt(Pyramid, number)
         : corners == 6 ? sideAt(Wedge, number)
                        : sideAt(Hexahedron, number);
}

std::span<const std::uint8_t> exodusEdge(std::size_t corners, std::uint32_t number)
{
  static constexpr std::array<std::array<std::uint8_t, 2>, 3> Triangle{ { { 0, 1 }, { 1, 2 },
    { 2, 0 } } };
  static constexpr std::array<std::array<std::uint8_t, 2>, 4> Quadrilateral{ { { 0, 1 }, { 1, 2 },
    { 2, 3 }, { 3, 0 } } };
  return corners == 3 ? sideAt(Triangle, number) : sideAt(Quadrilateral, number);
}

} // namespace

std::optional<ExodusShape> exodusShape(
  std::string_view type, std::int64_t nodes, std::int64_t dimensions)
{
  std::string upper(type.substr(0, 3));
  std::ranges::transform(
    upper, upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const auto isOneOf = [nodes](std::initializer_list<std::int64_t> counts)
  { return std::ranges::find(counts, nodes) != counts.end(); };
  const bool isShell = dimensions == 3;
  const auto surface = [&](std::uint8_t corners) {
    return std::optional(ExodusShape{ 2, corners, isShell });
  };
  if (upper == "TET" && isOneOf({ 4, 8, 10, 11, 14, 15 }))
  {
    return ExodusShape{ 3, 4 };
  }
  if (upper == "HEX" && isOneOf({ 8, 9, 20, 21, 27 }))
  {
    return ExodusShape{ 3, 8 };
  }
  if (upper == "WED" && isOneOf({ 6, 12, 15, 16, 18, 20, 21 }))
  {
    return ExodusShape{ 3, 6 };
  }
  if (upper == "PYR" && isOneOf({ 5, 13, 14, 18, 19 }))
  {
    return ExodusShape{ 3, 5 };
  }
  const bool isSurface = upper == "TRI" || upper == "SHE" || upper == "QUA";
  if (isSurface && isOneOf({ 3, 6, 7 }))
  {
    return surface(3);
  }
  if (isSurface && upper != "TRI" && isOneOf({ 4, 8, 9, 12, 16 }))
  {
    return surface(4);
  }
  if (upper == "TRI" && nodes == 4)
  {
    return surface(3); // with a node in the middle
  }
  const bool isLine = upper == "BAR" || upper == "BEA" || upper == "TRU" || upper == "EDG" ||
                      upper == "ROD" || upper == "LIN";
  if (isLine && isOneOf({ 2, 3, 4 }))
  {
    return ExodusShape{ 1, 2 };
  }
  return {};
}

ExodusSide exodusSide(int kind, std::size_t corners, std::uint32_t number)
{
  constexpr std::uint32_t FacesOfShell = 2;
  const bool isShell = kind >= 4;
  const int dimension = kind % 4;
  if (isShell && number <= FacesOfShell)
  {
    return { true, dimension };
  }
  return dimension == 3 ? ExodusSide{ false, 2, exodusFace(corners, number) }
         : dimension == 2
           ? ExodusSide{ false, 1, exodusEdge(corners, number - (isShell ? FacesOfShell : 0)) }
           : ExodusSide{};
}

} // namespace smg
