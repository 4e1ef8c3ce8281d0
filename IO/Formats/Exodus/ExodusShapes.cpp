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

std::span<const std::uint8_t> exodusFace(std::size_t corners, std::uint32_t number)
{
  static constexpr std::array<std::array<std::uint8_t, 3>, 4> Tetrahedron{ { { 0, 1, 3 },
    { 1, 2, 3 }, { 0, 3, 2 }, { 0, 2, 1 } } };
  static constexpr std::array<std::array<std::uint8_t, 4>, 6> Hexahedron{ { { 0, 1, 5, 4 },
    { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 0, 4, 7, 3 }, { 0, 3, 2, 1 }, { 4, 5, 6, 7 } } };
  static constexpr std::array<std::array<std::uint8_t, 4>, 5> Wedge{ { { 0, 1, 4, 3 },
    { 1, 2, 5, 4 }, { 0, 3, 5, 2 }, { 0, 2, 1, NoCorner }, { 3, 4, 5, NoCorner } } };
  static constexpr std::array<std::array<std::uint8_t, 4>, 5> Pyramid{ { { 0, 1, 4, NoCorner },
    { 1, 2, 4, NoCorner }, { 2, 3, 4, NoCorner }, { 0, 4, 3, NoCorner }, { 0, 3, 2, 1 } } };
  return corners == 4   ? sideOf(Tetrahedron, number)
         : corners == 5 ? sideOf(Pyramid, number)
         : corners == 6 ? sideOf(Wedge, number)
                        : sideOf(Hexahedron, number);
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
    return std::optional(ExodusShape{ { 2, isShell }, corners });
  };
  if (upper == "TET" && isOneOf({ 4, 8, 10, 11, 14, 15 }))
  {
    return ExodusShape{ { 3 }, 4 };
  }
  if (upper == "HEX" && isOneOf({ 8, 9, 20, 21, 27 }))
  {
    return ExodusShape{ { 3 }, 8 };
  }
  if (upper == "WED" && isOneOf({ 6, 12, 15, 16, 18, 20, 21 }))
  {
    return ExodusShape{ { 3 }, 6 };
  }
  if (upper == "PYR" && isOneOf({ 5, 13, 14, 18, 19 }))
  {
    return ExodusShape{ { 3 }, 5 };
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
    return ExodusShape{ { 1 }, 2 };
  }
  return {};
}

ElementSide exodusSide(ElementKind kind, std::size_t corners, std::uint32_t number)
{
  constexpr std::uint32_t FacesOfShell = 2;
  const auto [dimension, isShell] = kind;
  if (isShell && number <= FacesOfShell)
  {
    return { true, dimension };
  }
  return dimension == 3 ? ElementSide{ false, 2, exodusFace(corners, number - 1) }
         : dimension == 2
           ? ElementSide{ false, 1, edgeOf(corners, number - 1 - (isShell ? FacesOfShell : 0)) }
           : ElementSide{};
}

} // namespace smg
