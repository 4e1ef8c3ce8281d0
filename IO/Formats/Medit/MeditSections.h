// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace smg
{

/** A section of elements that become cells, and their corners. */
struct MeditSection
{
  std::string_view keyword;
  std::size_t corners;
  std::int32_t code; ///< of the keyword in binary files
};
inline constexpr std::array<MeditSection, 6> MeditSections{ { { "Triangles", 3, 6 },
  { "Quadrilaterals", 4, 7 }, { "Tetrahedra", 4, 8 }, { "Hexahedra", 8, 10 }, { "Prisms", 6, 9 },
  { "Pyramids", 5, 49 } } };

/** Passes an element of the section to the builder. */
inline void addMeditElement(
  RawMeshBuilder& builder, const MeditSection& section, std::span<const std::int64_t> corners)
{
  switch (section.keyword[0])
  {
    case 'Q':
      builder.polygon(corners);
      break;
    case 'T':
      corners.size() == 3 ? builder.triangle(corners[0], corners[1], corners[2])
                          : builder.tetrahedron(corners[0], corners[1], corners[2], corners[3]);
      break;
    default:
      corners.size() == 6 ? builder.invertedPrism(corners) : builder.solid(corners);
  }
}

} // namespace smg
