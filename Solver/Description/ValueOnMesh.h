// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Description/OpenValues.h"
#include "Solver/Description/Selection.h"
#include "Solver/Description/ValueRules.h"
#include "smg/ProblemDescription.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** A value of a description on its mesh, block by block of the stream. Blocks come in order; with
 * the first one it begins anew. */
class ValueOnMesh
{
public:
  /** `key` is its place in the description. Throws Error if the rules forbid it, the mesh has no
   * such column. */
  ValueOnMesh(const DataValue& value, DataPlace place, const ValueRules& rules,
    const std::string& key, MeshColumns& columns);

  int components() const { return this->Components; }
  /** Whether it is the same everywhere; then its numbers are as the rules say. */
  bool isConstant() const { return this->What == Constant; }
  /** What complaints call the numbers, as "the column 'k'". */
  std::string name() const
  {
    return this->What == Coordinates ? "the position" : "the column '" + this->Values.name + '\'';
  }

  /** To be called with each block in turn, before the others are; it must stay until the next. */
  void startBlock(const MeshBlock& block);
  /** Copies the value at vertex `i` of the block that was started. */
  void atVertex(const MeshBlock& block, std::size_t i, double* value) const;
  /** That in a cell of the block with these corners: of what the vertices have, the mean. */
  void atCell(std::size_t cell, const std::int64_t* corners, double* value) const;
  /** That at a corner, a stream index, of a cell: of what cells have, that of the cell. */
  void atCorner(std::size_t cell, std::int64_t corner, double* value) const;

private:
  enum Kind
  {
    Constant,
    OfVertices,
    OfCells,
    Coordinates
  };
  void requireRules(const DataValue& value, const ValueRules& rules, const std::string& key,
    const MeshColumns& columns) const;

  Kind What = Constant;
  DataPlace Place;
  int Components = 1;
  int Corners;
  std::vector<double> Numbers;
  NamedColumn Values;
  const Column* Current = nullptr; ///< the values in the block that was started
  OpenValues<double> Open;         ///< those of the vertices, for cells and facets
  std::int64_t Finalized = 0;
};

} // namespace smg
