// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/MeshColumns.h"
#include "Solver/Problem/OpenValues.h"
#include "Solver/Problem/Selection.h"
#include "smg/Export.h"
#include "smg/ProblemDescription.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** The admissible range of the numbers of a datum. They and their squares must also be finite. */
enum class ValueRange
{
  Any,
  NotNegative,
  PositiveDefinite ///< a positive number, three (a diagonal), or a tensor of six
};

/** The admissible values of a datum. */
struct SMG_EXPORT ValueRules
{
  std::vector<int> components; ///< the admissible numbers of components
  ValueRange range = ValueRange::Any;
  bool positions = false;                        ///< whether it may be the position
  bool missing = false;                          ///< whether NaN stands for a missing value
  ColumnOwner preferred = ColumnOwner::Vertices; ///< owner of the column if both have one

  /** The error of invalid numbers, for example "must be finite"; null if valid. */
  const char* complaint(const double* numbers, int count) const;
};

/**
 * The symmetric tensor xx, yy, zz, xy, yz, xz from one number, a diagonal, or all six components.
 */
std::array<double, 6> tensorOf(const double* numbers, int count);

/** A value of a description on its mesh, block by block of the stream. Blocks are passed in order,
 * also those without vertices; the first block restarts it. */
class Coefficient
{
public:
  /** `key` is the place of the value in the description. Throws Error if the value violates the
   * rules or the mesh has no such column. */
  Coefficient(const DataValue& value, DataPlace place, const ValueRules& rules,
    const std::string& key, MeshColumns& columns);

  int components() const { return this->Components; }
  /** Whether it is constant; then its numbers are known to satisfy the rules. */
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
    /** Copies the value at a corner (a stream index) of a cell; a column of the cells has the value
     * of the cell there. */
    void atCorner(std::size_t cell, std::int64_t corner, double* value) const;

  private:
    friend class Coefficient;
    InBlock(const Coefficient& value, const MeshBlock& block);
    /** Copies a row of the column. */
    void copyRow(std::size_t row, double* value) const;

    const Coefficient& Value;
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
