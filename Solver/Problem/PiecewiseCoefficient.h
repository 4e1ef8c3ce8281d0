// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/Coefficient.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/**
 * A datum of a description on its mesh, block by block of the stream: the entry that applies at
 * each place, and its value. Blocks are passed in order, also those without vertices; the first
 * block restarts it.
 */
class PiecewiseCoefficient
{
public:
  PiecewiseCoefficient(MeshColumns& columns, DataPlace place, ValueRules rules)
    : Columns(&columns)
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

  /** Whether an entry selects a part of the mesh. Reading the stream checks that it is not empty.
   */
  bool selects() const;
  /** Whether the stream must be read before selections can be evaluated. */
  bool needsPreparing() const;
  /** See Selection. */
  void prepare(const MeshBlock& block, const std::filesystem::path& scratch);
  void endPreparing(MeshParts* parts);
  void startBlock(const MeshBlock& block);

  /** Sets `entry` to the number of the entry that applies at each vertex of the block. Where none
   * does, it is left unchanged. */
  void entriesAtVertices(std::span<std::int32_t> entry) const;
  /** Likewise in cells of the block, and on their facets, as many per cell as corners. */
  void entriesAtCells(const CellRange& cells, std::span<std::int32_t> entry) const;
  void entriesAtFacets(const CellRange& cells, std::span<std::int32_t> entry) const;

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
    std::unique_ptr<Selection> where; ///< null: everywhere
    Coefficient value;
    std::string key; ///< of the value
  };

  /** Throws Error if the numbers of an entry violate the rules; `where` returns the place. */
  void require(const Entry& entry, const double* numbers, auto where) const;
  /** Calls `visit(entry, its values in the block, k)` for each k with an entry. */
  void forEntries(const MeshBlock& block, std::span<const std::int32_t> entry, auto visit) const;
  const Entry& at(std::int32_t entry) const
  {
    return this->Entries[static_cast<std::size_t>(entry)];
  }

  MeshColumns* Columns;
  DataPlace Place;
  ValueRules Rules;
  std::vector<Entry> Entries;
  mutable std::vector<std::uint8_t> Selected; ///< of a range of cells
};

} // namespace smg
