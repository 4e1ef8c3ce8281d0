// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Deformation/Handles.h"

#include <array>
#include <string>
#include <vector>

namespace smg
{

/**
 * Handles that stand in the vertex columns HandleMask (one number, 0 to 255), HandleTarget and
 * HandleRotation (three) and HandleLogScale (one) of the mesh stream, of any scalar type.
 */
class ColumnHandles : public Handles
{
public:
  /** Throws Error if one of the columns is absent or has another number of components. */
  explicit ColumnHandles(const std::vector<ColumnSpec>& vertexColumns);

  /** The names of the four columns. */
  static const std::array<std::string, 4>& names();

  /** Whether a column of this name is one of the four. */
  static bool isName(const std::string& name);

  /** Throws Error, which names the column and the vertex, if a number there is not finite. */
  void at(const MeshBlock& block, VertexHandles& handles) override;

private:
  std::array<int, 4> Places; ///< of names() in MeshBlock::vertexColumns
};

} // namespace smg
