// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Description/MeshColumns.h"
#include "Solver/Description/OpenValues.h"
#include "smg/Region.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace smg
{

/** What of the mesh a datum belongs to. */
enum class DataPlace
{
  Vertices,
  Cells,
  Facets ///< of the boundary, though here all facets are looked at
};

/** A stretch of the cells of a block; `corners` are theirs. */
struct CellRange
{
  const MeshBlock& block;
  std::size_t first; ///< numbered in the block
  std::span<const std::int64_t> corners;
};

/**
 * A part of a description's mesh (see Where), block by block of the stream. Blocks come in order;
 * with the first one it begins anew.
 */
class Selection
{
public:
  /** Null: everywhere. `place`: of what it is asked. `key` is its place in the description. Throws
   * Error if the mesh has no such column or the region is wrong. */
  static std::unique_ptr<Selection> make(const Where& where, DataPlace place, ColumnOwner preferred,
    const std::string& key, MeshColumns& columns);
  virtual ~Selection() = default;

  /** Whether it has still to read the stream before it can answer. */
  virtual bool needsPreparing() const { return false; }
  /**
   * To be called with all blocks of the stream, then endPreparing(): learns what can be known only
   * then, and looks whether anything is selected. Scratch files go to `scratch`.
   */
  virtual void prepare(const MeshBlock& block, const std::filesystem::path& scratch);
  /** Throws Error naming the place in the description if nothing is selected. */
  virtual void endPreparing();

  /** To be called with each block in turn, before the others are. */
  void startBlock(const MeshBlock& block);
  /** Of the vertices of the block that was started: 1 where selected, else 0. */
  std::span<const std::uint8_t> atVertices() const { return this->Current; }
  /** Of cells of that block: 1 where selected, else 0. */
  virtual void atCells(const CellRange& cells, std::span<std::uint8_t> selected) const;
  /** Of the facets of cells: bit k of `selected` is that of the facet opposite to corner k. */
  virtual void atFacets(const CellRange& cells, std::span<std::uint8_t> selected) const;

protected:
  Selection(DataPlace place, std::string key, const MeshColumns& columns)
    : Columns(columns)
    , Place(place)
    , Key(std::move(key))
  {
  }

  /** Sets `selected`, zeroed, to 1 at the vertices of the block that are selected. */
  virtual void select(const MeshBlock& block, std::span<std::uint8_t> selected) = 0;
  /** What is said of something that is selected, as "is in this region". */
  virtual std::string predicate() const { return "is selected"; }

  const MeshColumns& Columns;
  DataPlace Place;
  std::string Key;
  std::int64_t Count = 0; ///< of what is selected, while preparing

private:
  OpenValues<std::uint8_t> Open;
  std::int64_t Finalized = 0; ///< of the block before
  std::span<const std::uint8_t> Current;
};

} // namespace smg
