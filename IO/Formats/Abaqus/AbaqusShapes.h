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
struct AbaqusShape
{
  std::uint8_t dimension = 0;
  std::uint8_t corners = 0; ///< the first of its nodes
  std::uint8_t nodes = 0;
  bool isShell = false; ///< a surface in space, whose sides 1 and 2 are its faces

  /** As one number, for ListedElements. */
  int kind() const { return this->dimension + (this->isShell ? 4 : 0); }
};

/** The shape of a type, as C3D4 or CPS3, in capitals; none: elements of the type have no cells, or
 * are not known. */
std::optional<AbaqusShape> abaqusShape(std::string_view type);

/** The number that stands for a side in surfaces: S1 or E1, SPOS, SNEG; none: it has another name.
 */
std::optional<std::uint32_t> abaqusSideNumber(std::string_view name);

/** The side of this number, of elements of this kind with so many corners. */
ElementSide abaqusSide(int kind, std::size_t corners, std::uint32_t number);

/** The name of the face of a tetrahedron, or of the edge of a triangle, opposite to a corner. */
const char* abaqusFaceName(std::size_t cornersOfCell, std::size_t opposite);

} // namespace smg
