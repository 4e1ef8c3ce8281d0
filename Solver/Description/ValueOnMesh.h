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

/** A value of a description on its mesh, block by block of the stream. Blocks are passed in order;
 * the first block restarts it. */
class ValueOnMesh
{
public:
  /** `key` is its place in the description. Throws Error if it violates the rules or the mesh has
   * no such column. */
  ValueOnMesh(const DataValue& value, DataPlace place, const ValueRules& rules,
    const std::string& key, MeshColumns& columns);

  int components() const { return this->Components; }
  /** Whether it is constant; its numbers then satisfy the rules. */
  bool isConstant() const { return this->What == Constant; }
  /** The name of the value in error messages, for example "the column 'k'". */
  std::string name() const
  {
    return this->What == Coordinates ? "the position" : "the column '" + this->Values.name + '\'';
  }

  /** To be called with each block in order, before the methods below; it must stay valid until the
   * next. */
  void startBlock(const MeshBlock& block);
  /** Copies the value at vertex `i` of the current block. */
  void atVertex(const MeshBlock& block, std::size_t i, double* value) const;
  /** Copies the value in a cell with these corners; for a column of the vertices, the mean. */
  void atCell(std::size_t cell, const std::int64_t* corners, double* value) const;
  /** Copies the value at a corner (a stream index) of a cell; for a column of the cells, that of
   * the cell. */
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
  const Column* Current = nullptr; ///< the values in the current block
  OpenValues<double> Open;         ///< of the vertices, for cells and facets
  std::int64_t Finalized = 0;
};

} // namespace smg
