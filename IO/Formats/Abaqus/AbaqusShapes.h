// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/ElementSides.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace smg
{

/** The shape of the elements of a type of Abaqus and CalculiX. */
struct AbaqusShape : ElementKind
{
  std::uint8_t corners = 0; ///< the first of its nodes
  std::uint8_t nodes = 0;
};

/** The shape of a type, as C3D4 or CPS3, in capitals; none: elements of the type have no cells, or
 * are not known. */
std::optional<AbaqusShape> abaqusShape(std::string_view type);

/** The number that stands for a side in surfaces: S1 or E1, SPOS, SNEG; none: it has another name.
 */
std::optional<std::uint32_t> abaqusSideNumber(std::string_view name);

/** The side of this number, of elements of this kind with so many corners. */
ElementSide abaqusSide(ElementKind kind, std::size_t corners, std::uint32_t number);

/** The name of a side in groups: of the face of a tetrahedron opposite to this corner, or of this
 * edge of a polygon, see GroupSides::Side. */
const char* abaqusFaceName(bool isSolid, std::size_t side);

} // namespace smg
