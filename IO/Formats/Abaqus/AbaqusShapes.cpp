// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Abaqus/AbaqusShapes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <initializer_list>

namespace smg
{
namespace
{

/** Types whose names begin alike, followed by the number of nodes and perhaps by letters. */
struct AbaqusFamily
{
  std::string_view prefix;
  int dimension;
  bool isShell = false;
};

// Of prefixes that begin alike, the longer one comes first.
constexpr AbaqusFamily AbaqusFamilies[] = { { "C3D", 3 }, { "DC3D", 3 }, { "DCC3D", 3 },
  { "AC3D", 3 }, { "F3D", 3 }, { "FC3D", 3 }, { "COH3D", 3 }, { "SC", 3 }, { "CPS", 2 },
  { "CPEG", 2 }, { "CPE", 2 }, { "CAX", 2 }, { "DC2D", 2 }, { "DCC2D", 2 }, { "AC2D", 2 },
  { "DCAX", 2 }, { "ACAX", 2 }, { "STRI", 2, true }, { "SFM3D", 2, true }, { "S", 2, true },
  { "DS", 2, true }, { "M3D", 2, true }, { "R3D", 2, true }, { "F2D", 2 }, { "T3D", 1 },
  { "T2D", 1 }, { "DC1D", 1 } };

/** The corners of a shape of so many nodes; 0: there is none. */
std::uint8_t cornersOfNodes(int dimension, int nodes)
{
  const auto isOneOf = [nodes](std::initializer_list<int> counts)
  { return std::ranges::find(counts, nodes) != counts.end(); };
  switch (dimension)
  {
    case 1:
      return isOneOf({ 2, 3 }) ? 2 : 0;
    case 2:
      return isOneOf({ 3, 6 }) ? 3 : isOneOf({ 4, 8, 9 }) ? 4 : 0;
    default:
      return isOneOf({ 4, 10 })       ? 4
             : isOneOf({ 5, 13 })     ? 5
             : isOneOf({ 6, 15 })     ? 6
             : isOneOf({ 8, 20, 27 }) ? 8
                                      : 0;
  }
}

constexpr std::uint32_t WholeSide = 100;

std::span<const std::uint8_t> abaqusFace(std::size_t corners, std::uint32_t number)
{
  static constexpr std::array<std::array<std::uint8_t, 3>, 4> Tetrahedron{ { { 0, 1, 2 },
    { 0, 3, 1 }, { 1, 3, 2 }, { 2, 3, 0 } } };
  static constexpr std::array<std::array<std::uint8_t, 4>, 6> Hexahedron{ { { 0, 1, 2, 3 },
    { 4, 7, 6, 5 }, { 0, 4, 5, 1 }, { 1, 5, 6, 2 }, { 2, 6, 7, 3 }, { 3, 7, 4, 0 } } };
  static constexpr std::array<std::array<std::uint8_t, 4>, 5> Wedge{ { { 0, 1, 2, NoCorner },
    { 3, 5, 4, NoCorner }, { 0, 3, 4, 1 }, { 1, 4, 5, 2 }, { 2, 5, 3, 0 } } };
  static constexpr std::array<std::array<std::uint8_t, 4>, 5> Pyramid{ { { 0, 1, 2, 3 },
    { 0, 4, 1, NoCorner }, { 1, 4, 2, NoCorner }, { 2, 4, 3, NoCorner }, { 3, 4, 0, NoCorner } } };
  return corners == 4   ? sideOf(Tetrahedron, number)
         : corners == 5 ? sideOf(Pyramid, number)
         : corners == 6 ? sideOf(Wedge, number)
                        : sideOf(Hexahedron, number);
}

} // namespace

std::optional<AbaqusShape> abaqusShape(std::string_view type)
{
  const auto beamNodes = [](std::string_view name) {
    return name == "B32" || name == "B22" ? 3 : name.size() >= 3 && name[0] == 'B' ? 2 : 0;
  };
  if (const int nodes = beamNodes(type.substr(0, 3));
      nodes > 0 && type.size() >= 3 && (type[1] == '2' || type[1] == '3'))
  {
    return AbaqusShape{ { 1 }, 2, static_cast<std::uint8_t>(nodes) };
  }
  for (const AbaqusFamily& family : AbaqusFamilies)
  {
    int nodes = 0;
    const char* const end = type.data() + type.size();
    if (!type.starts_with(family.prefix) ||
        std::from_chars(type.data() + family.prefix.size(), end, nodes).ec != std::errc())
    {
      continue;
    }
    nodes = family.prefix == "STRI" && nodes == 65 ? 6 : nodes;
    if (const std::uint8_t corners = cornersOfNodes(family.dimension, nodes))
    {
      return AbaqusShape{ { static_cast<std::uint8_t>(family.dimension), family.isShell }, corners,
        static_cast<std::uint8_t>(nodes) };
    }
  }
  return {};
}

std::optional<std::uint32_t> abaqusSideNumber(std::string_view name)
{
  if (name == "SPOS" || name == "SNEG" || name == "SP" || name == "SN" || name == "S")
  {
    return WholeSide;
  }
  // The edges of shells are numbered behind their two faces in CalculiX, and from E1 on in Abaqus.
  const bool isEdge = name.size() == 2 && name[0] == 'E';
  const bool isSide = name.size() == 2 && name[0] == 'S';
  if ((!isEdge && !isSide) || name[1] < '1' || name[1] > '6')
  {
    return {};
  }
  constexpr std::uint32_t FirstEdge = 10;
  return static_cast<std::uint32_t>(name[1] - '1') + (isEdge ? FirstEdge : 0);
}

ElementSide abaqusSide(ElementKind kind, std::size_t corners, std::uint32_t number)
{
  constexpr std::uint32_t FirstEdge = 10, FacesOfShell = 2;
  const auto [dimension, isShell] = kind;
  if (number == WholeSide || (isShell && number < FacesOfShell))
  {
    return { true, dimension };
  }
  if (dimension == 3)
  {
    return { false, 2, abaqusFace(corners, number) };
  }
  if (dimension == 2)
  {
    const std::uint32_t edge = number >= FirstEdge ? number - FirstEdge
                               : isShell           ? number - FacesOfShell
                                                   : number;
    return { false, 1, edgeOf(corners, edge) };
  }
  return {};
}

const char* abaqusFaceName(bool isSolid, std::size_t side)
{
  constexpr std::array OfTetrahedron{ "S3", "S4", "S2", "S1" };
  constexpr std::array OfPolygon{ "E1", "E2", "E3", "E4" };
  return isSolid ? OfTetrahedron[side] : OfPolygon[side];
}

} // namespace smg
