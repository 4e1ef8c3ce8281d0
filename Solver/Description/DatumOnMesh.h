// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Description/ValueOnMesh.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/**
 * A datum of a description on its mesh, block by block of the stream: which of its entries counts
 * where, and what it says there. Blocks come in order, and stay until the next one; with the first
 * one it begins anew.
 */
class DatumOnMesh
{
public:
  DatumOnMesh(MeshColumns& columns, DataPlace place, ValueRules rules)
    : Columns(&columns)
    , Place(place)
    , Rules(std::move(rules))
  {
  }

  /** Adds an entry, which counts before those so far. `key` and `valueKey` are its place in the
   * description and that of its value. Throws Error. */
  void add(const Where& where, const DataValue& value, const std::string& key,
    const std::string& valueKey);
  /** Adds those of a datum. */
  void add(const Datum& datum, const std::string& key);

  bool isGiven() const { return !this->Entries.empty(); }
  int entries() const { return static_cast<int>(this->Entries.size()); }
  /** The numbers of an entry's value. */
  int components(std::int32_t entry) const { return this->at(entry).value.components(); }

  /** Whether a part of the mesh is selected: then the stream can be read for checks. */
  bool selects() const;
  /** Whether the stream has still to be read before it can answer. */
  bool needsPreparing() const;
  /** See Selection. */
  void prepare(const MeshBlock& block, const std::filesystem::path& scratch);
  void endPreparing();
  void startBlock(const MeshBlock& block);

  /** Sets `entry` to the entry that counts at each vertex of the block; as it was: there is none.
   */
  void entriesAtVertices(std::span<std::int32_t> entry) const;
  /** Likewise in cells of the block, and on their facets, as many a cell as corners. */
  void entriesAtCells(const CellRange& cells, std::span<std::int32_t> entry) const;
  void entriesAtFacets(const CellRange& cells, std::span<std::int32_t> entry) const;

  /** Copies what entries say at the vertices of the block, `stride` numbers apart; -1: nothing.
   * Throws Error if a value is not as the rules say. */
  void valuesAtVertices(const MeshBlock& block, std::span<const std::int32_t> entry, double* values,
    std::size_t stride) const;
  /** Likewise in cells. */
  void valuesAtCells(const CellRange& cells, std::span<const std::int32_t> entry, double* values,
    std::size_t stride) const;
  /** Likewise at the corners of the facets of cells; where a value is not valid, NaN: most facets
   * are inside the body, where nobody asks for it. */
  void valuesAtFacets(const CellRange& cells, std::span<const std::int32_t> entry, double* values,
    std::size_t stride) const;

private:
  struct Entry
  {
    std::unique_ptr<Selection> where; ///< null: everywhere
    ValueOnMesh value;
    std::string key; ///< of the value
  };

  /** Throws Error if the numbers of an entry are not as the rules say; `where` tells the place. */
  void require(const Entry& entry, const double* numbers, auto where) const;
  const Entry& at(std::int32_t entry) const
  {
    return this->Entries[static_cast<std::size_t>(entry)];
  }

  MeshColumns* Columns;
  DataPlace Place;
  ValueRules Rules;
  std::vector<Entry> Entries;
  mutable std::vector<std::uint8_t> Selected; ///< of a stretch of cells
};

} // namespace smg
