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
#include <span>
#include <string>
#include <utility>
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
};

/**
 * A datum of a description on its mesh, block by block of the stream: the entry that applies at
 * each place, and its value. Blocks are passed in order, also those without vertices; the first
 * block restarts it.
 */
class PiecewiseCoefficient
{
public:
  /** Its selections are added to `selections`, which the user prepares and starts. */
  PiecewiseCoefficient(
    MeshColumns& columns, Selections& selections, DataPlace place, ValueRules rules)
    : Columns(&columns)
    , Parts(&selections)
    , Place(place)
    , Rules(std::move(rules))
  {
  }

  /** Adds an entry, which takes precedence over the previous ones. `key` and `valueKey` are the
   * places of the entry and of its value in the description, for messages. Throws Error. */
  void add(const Where& where, const DataValue& value, const std::string& key,
    const std::string& valueKey);
  /** Adds the entries of a datum. */
  void add(const Datum& datum, const std::string& key);

  bool isGiven() const { return !this->Entries.empty(); }
  int entries() const { return static_cast<int>(this->Entries.size()); }
  /** The number of components of the value of an entry. */
  int components(std::int32_t entry) const { return this->at(entry).value.components(); }

  DataPlace place() const { return this->Place; }

  /** To be called with each block in order, after Selections::startBlock(). */
  void startBlock(const MeshBlock& block);

  /** Sets `entry` to the number of the entry that applies at each vertex of the block. Where none
   * does, it is left unchanged. */
  void entriesAtVertices(std::span<std::int32_t> entry) const;
  /** Likewise with this entry alone. */
  void entryAtVertices(std::int32_t e, std::span<std::int32_t> entry) const;
  /** Likewise in cells of the block, and on their facets, as many per cell as corners. */
  void entriesAtCells(const CellRange& cells, std::span<std::int32_t> entry) const;
  void entriesAtFacets(const CellRange& cells, std::span<std::int32_t> entry) const;
  /** Likewise on facets between cells, of the entries that hold there. */
  void entriesAtInnerFacets(const CellRange& cells, std::span<std::int32_t> entry) const;

  /** Copies the values of entries at the vertices of the block, `stride` numbers apart; -1: no
   * entry. Throws Error if a value violates the rules. */
  void valuesAtVertices(const MeshBlock& block, std::span<const std::int32_t> entry, double* values,
    std::size_t stride) const;
  /** Likewise in cells. */
  void valuesAtCells(const CellRange& cells, std::span<const std::int32_t> entry, double* values,
    std::size_t stride) const;
  /** Likewise at the corners of the facets of cells; an invalid value becomes NaN, since the values
   * of most facets, in the interior, are not used. */
  void valuesAtFacets(const CellRange& cells, std::span<const std::int32_t> entry, double* values,
    std::size_t stride) const;

private:
  struct Entry
  {
    const Selection* where; ///< null: everywhere
    Coefficient value;
    std::string key; ///< of the value
  };

  void select(std::span<std::int32_t> entry, std::size_t places, auto select) const;
  /** Sets `entry` to e where `Selected` has the bit of the place. */
  void set(std::int32_t e, std::span<std::int32_t> entry, std::size_t places) const;
  /** Throws Error if the numbers of an entry violate the rules; `where` returns the place. */
  void require(const Entry& entry, const double* numbers, auto where) const;
  /** Calls `visit(entry, its values in the block, k)` for each k with an entry. */
  void forEntries(const MeshBlock& block, std::span<const std::int32_t> entry, auto visit) const;
  const Entry& at(std::int32_t entry) const
  {
    return this->Entries[static_cast<std::size_t>(entry)];
  }

  MeshColumns* Columns;
  Selections* Parts;
  DataPlace Place;
  ValueRules Rules;
  std::vector<Entry> Entries;
  mutable std::vector<std::uint8_t> Selected; ///< of a range of cells, by select()
};

} // namespace smg
