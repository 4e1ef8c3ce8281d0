// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Facets.h"
#include "Solver/Problem/MeshColumns.h"
#include "Solver/Problem/OpenValues.h"
#include "smg/Region.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace smg
{

class OpenFacets;

/**
 * What a selection must know of the other parts if a mesh is distributed over processes. Each
 * process knows one part and has its own numbering of the vertices there. All processes call each
 * function, in the same order.
 */
class MeshParts
{
public:
  virtual ~MeshParts() = default;

  /** Replaces each number by its sum over all parts. */
  virtual void sum(std::span<std::int64_t> counts) = 0;
  /** Marks the vertices of the part that any part marks with 1. */
  virtual void join(std::span<std::uint8_t> marks) = 0;
  /**
   * On entry: the vertex of the part that is nearest to each point, or -1, and its distance. On
   * return: the nearest vertex of all parts, of equally near ones the first in stream order, or -1
   * if the part does not have it.
   */
  virtual void nearest(std::span<double> distances, std::span<std::int64_t> vertices) = 0;
  /** The facets that have one cell in this part but more than one in all parts together. `facets`
   * are the facets of the cells of this part. */
  virtual FacetSet innerFacets(const OpenFacets& facets) = 0;
};

class VertexSetFile;

/** The entities of the mesh on which a datum is defined. */
enum class DataPlace
{
  Vertices,
  Cells,
  Facets ///< boundary facets; selections treat all facets
};

/** The column by which a part of the mesh is selected; null for other parts. */
inline const std::string* columnOf(const Where& where)
{
  const auto* tag = std::get_if<ColumnTag>(&where);
  const auto* mask = std::get_if<ColumnMask>(&where);
  return tag ? &tag->column : mask ? &mask->column : nullptr;
}

/** The names of the groups of a place, for messages and reports; "": it is another. */
std::string groupNames(const Where& where);

/** Whether a density with this part of the mesh is one in cells: by a column of theirs or by a
 * group, or if any part is of which it consists. Columns of the vertices take precedence, groups of
 * cells as well. So is one with a group of facets alone, where no density can be. */
bool isOfCells(const Where& where, const MeshColumns& columns);

/** A range of the cells of a block with their `corners`. */
struct CellRange
{
  const MeshBlock& block;
  std::size_t first; ///< index in the block
  std::span<const std::int64_t> corners;
};

/** The selection of a part of the mesh (see Where), block by block of the stream. Blocks are passed
 * in order; the first block restarts it. */
class Selection
{
public:
  /** Creates the selection; null: everywhere. `place` are the selected entities, `key` is the place
   * in the description. Throws Error if the mesh has no such column or the region is invalid. */
  static std::unique_ptr<Selection> make(const Where& where, DataPlace place, ColumnOwner preferred,
    const std::string& key, MeshColumns& columns);
  virtual ~Selection() = default;

  /** Whether the stream must be read before the selection can be evaluated. */
  virtual bool needsPreparing() const { return false; }
  /**
   * To be called with all blocks of the stream, followed by endPreparing(): determines data that
   * requires the whole stream, and whether anything is selected. Scratch files are created in
   * `scratch`. The first block begins anew, whatever an earlier reading has found.
   */
  void prepare(const MeshBlock& block, const std::filesystem::path& scratch);
  /** Throws Error, which names the place in the description, if nothing is selected. `parts`: the
   * other parts of the mesh, if the stream is only one of several; else null. */
  virtual void endPreparing(MeshParts* parts);
  /** That nothing is selected is no error any more. */
  void acceptEmpty() { this->MayBeEmpty = true; }

  /** To be called with what atCells() selects of all cells, in order, where a datum of cells is
   * evaluated. That a place that is known only after preparation has no cell is seen here: throws
   * Error at the last cell. */
  void checkCells(const CellRange& cells, std::span<const std::uint8_t> selected) const;

  /** The selected vertices, if preparation stores them, after endPreparing(); else null. */
  virtual VertexSetFile* preparedVertices() { return nullptr; }

  /** To be called with each block in order, before the methods below. */
  void startBlock(const MeshBlock& block);
  /** For the vertices of the current block: 1 where selected, else 0. */
  std::span<const std::uint8_t> atVertices() const { return this->Current; }
  /** For cells of the current block: 1 where selected, else 0. */
  virtual void atCells(const CellRange& cells, std::span<std::uint8_t> selected) const;
  /** For the facets of cells: bit k of `selected` is 1 if the facet opposite to corner k is
   * selected. */
  virtual void atFacets(const CellRange& cells, std::span<std::uint8_t> selected) const;
  /** The same for facets that are selected as such, also between two cells; of these one has it. */
  virtual void atInnerFacets(const CellRange& cells, std::span<std::uint8_t> selected) const
  {
    std::ranges::fill(selected.first(static_cast<std::size_t>(std::ssize(cells.corners)) /
                                     static_cast<std::size_t>(cornersOf(this->Columns.cellType()))),
      std::uint8_t(0));
  }

protected:
  Selection(DataPlace place, std::string key, const MeshColumns& columns)
    : Columns(columns)
    , Place(place)
    , Key(std::move(key))
    , Open(columns.memory())
  {
  }

  /** Forgets what was prepared. */
  virtual void begin() { this->Count = 0; }
  /** Goes on to a block; returns what atVertices() does, at first 0. */
  std::span<std::uint8_t> open(const MeshBlock& block);
  /** Prepares a block. */
  virtual void add(const MeshBlock& block, const std::filesystem::path& scratch);
  /** Sets `selected`, initially zero, to 1 at the selected vertices of the block. */
  virtual void select(const MeshBlock& block, std::span<std::uint8_t> selected) = 0;
  /** The predicate of a selected item for messages, for example "is in this region". */
  virtual std::string predicate() const { return "is selected"; }
  /** What the mesh has instead, as the end of such a message. Not used if the mesh is in parts. */
  virtual std::string instead() const { return {}; }

  const MeshColumns& Columns;
  DataPlace Place;
  std::string Key;
  std::int64_t Count = 0; ///< of selected items, during preparation

private:
  OpenValues<std::uint8_t> Open;
  bool MayBeEmpty = false;
  bool IsWhole = false; ///< whether it has been prepared, with the whole mesh
  mutable bool HasCells = false;
  std::span<const std::uint8_t> Current;
};

/** Why a place cannot be the groups of this name, which has none of a kind that is possible there.
 */
std::string whyNoGroup(const std::string& name, const MeshGroups& groups);

/** The number of points of a place that names points one by one; 0 if it is a region. */
std::size_t pointsOf(const Where& place);

/** The selections of a description, which are prepared and pass through the stream together. */
class Selections
{
public:
  explicit Selections(MeshColumns& columns)
    : Columns(columns)
  {
  }

  /** Adds a selection, see Selection::make(); null: everywhere. */
  Selection* add(
    const Where& where, DataPlace place, ColumnOwner preferred, const std::string& key);

  /** Whether the stream must be read before all of them can be evaluated. */
  bool needPreparing() const;
  /** Reads the stream, unless there are none, to be followed by endPreparing(). The memory of what
   * is kept meanwhile is limited. Throws Error for an invalid stream. `visit` is called with each
   * block for which they have been prepared. */
  void prepare(MeshSource& mesh, const std::filesystem::path& scratch, std::int64_t memoryLimit,
    const std::function<void(const MeshBlock& prepared)>& visit = {});
  /** See Selection. */
  void prepare(const MeshBlock& block, const std::filesystem::path& scratch);
  void endPreparing(MeshParts* parts);
  /** See Selection. */
  void acceptEmpty();
  void startBlock(const MeshBlock& block);

private:
  MeshColumns& Columns;
  std::vector<std::unique_ptr<Selection>> All;
  bool IsLimited = false; ///< whether prepare() has limited the memory
};

/** The vertices in a region. */
class RegionSelection : public Selection
{
public:
  RegionSelection(
    const Region& region, DataPlace place, const std::string& key, MeshColumns& columns);

  void endPreparing(MeshParts* parts) override;

protected:
  void begin() override;
  void add(const MeshBlock& block, const std::filesystem::path& scratch) override;
  void select(const MeshBlock& block, std::span<std::uint8_t> selected) override;
  std::string predicate() const override { return "is in this region"; }

private:
  Region Selected;
  std::vector<std::int64_t> Found; ///< how often the mesh has each vertex of the region
};

} // namespace smg
