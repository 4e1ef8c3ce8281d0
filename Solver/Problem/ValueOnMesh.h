// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/OpenValues.h"
#include "Solver/Problem/Selection.h"
#include "Solver/Problem/ValueRules.h"
#include "smg/ProblemDescription.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** A value of a description on its mesh, block by block of the stream. Blocks are passed in order,
 * also those without vertices; the first block restarts it. */
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

  /** To be called with each block in order, before in(). */
  void startBlock(const MeshBlock& block);

  /** The values in a block; valid as long as the block. */
  class InBlock
  {
  public:
    /** Copies the value at vertex `i` of the block. */
    void atVertex(std::size_t i, double* value) const;
    /** Copies the value in a cell with these corners; for a column of the vertices, the mean. */
    void atCell(std::size_t cell, const std::int64_t* corners, double* value) const;
    /** Copies the value at a corner (a stream index) of a cell; for a column of the cells, that of
     * the cell. */
    void atCorner(std::size_t cell, std::int64_t corner, double* value) const;

  private:
    friend class ValueOnMesh;
    InBlock(const ValueOnMesh& value, const MeshBlock& block);
    /** Copies a row of the column. */
    void copyRow(std::size_t row, double* value) const;

    const ValueOnMesh& Value;
    const MeshBlock& Block;
    const Column* Rows; ///< null: a constant or the position
  };

  /** The values in `block`, the current one. */
  InBlock in(const MeshBlock& block) const { return { *this, block }; }

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
  OpenValues<double> Open; ///< of the vertices, for cells and facets
  std::int64_t Finalized = 0;
};

} // namespace smg
