// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace smg
{

/** A section of elements that become cells, and their corners. */
struct MeditSection
{
  std::string_view keyword;
  int dimension;
  std::size_t corners;
  std::int32_t code; ///< of the keyword in binary files
};
inline constexpr std::array<MeditSection, 6> MeditSections{ { { "Triangles", 2, 3, 6 },
  { "Quadrilaterals", 2, 4, 7 }, { "Tetrahedra", 3, 4, 8 }, { "Hexahedra", 3, 8, 10 },
  { "Prisms", 3, 6, 9 }, { "Pyramids", 3, 5, 49 } } };

} // namespace smg
