// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Distance/SourceLabel.h"
#include "Solver/Problem/Selection.h"
#include "smg/MeshSource.h"
#include "smg/Region.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** What a vertex is for a distance. Points are sources of their own; between vertices of regions
 * that share a cell, the edge or face is a source, too. */
enum SourceKind : std::uint8_t
{
  NoSource = 0,
  PointSource = 1,
  RegionSource = 3
};

/** The sources of a distance: vertices or facets that are selected on a mesh. */
class DistanceSources
{
public:
  /** `place` is what is selected, `name` the name of the description in messages, and `key` that of
   * `from` in it; `memory` accounts for open vertices. `grouped`: labels have the places, too.
   * Throws Error if a selection is invalid. */
  DistanceSources(const std::vector<Where>& from, DataPlace place, bool grouped,
    const StreamInfo& mesh, const std::string& name, Pool& memory, const std::string& key = "from");

  /** The stream with the columns that the selections need. */
  std::unique_ptr<MeshSource> read(const StoredMesh& mesh) const;

  /** Reads the mesh, if a selection needs a reading beforehand. */
  void prepare(const StoredMesh& mesh, const std::filesystem::path& scratch);
  /** For the vertices of the next block of the stream, their SourceKind. */
  std::span<const std::uint8_t> verticesAt(const MeshBlock& block);
  /** For the cells of the next block: bit k is 1 if the facet opposite to corner k is selected. */
  std::span<const std::uint8_t> facetsAt(const MeshBlock& block);
  /** The same for those that are selected as facets, after facetsAt() of the block: they are
   * sources between two cells, too. Of these, one has the bit. */
  std::span<const std::uint8_t> innerFacets() const { return this->Inner; }
  /** The number of vertex `i` of the block in the original file, or in the stream. */
  std::int64_t numberOf(const MeshBlock& block, std::size_t i) const;
  /** The first place of `from` that selects vertex `k` of the block, or facet `k`, where these are
   * numbered cell by cell; 0 if groups are not asked for. */
  std::int32_t group(std::size_t k) const { return this->Grouped ? this->Groups[k] : 0; }
  /** What is stored of a source: SourceLabel.h. */
  std::int64_t label(std::int64_t number, std::int32_t group) const
  {
    return this->Grouped ? labelOf(number, group) : number;
  }
  /** To be called after the last block: throws Error if a selection was empty. */
  void finish();

private:
  /** Starts the next block. */
  void start(const MeshBlock& block);
  /** Of what part `part` selects besides those before: bits, of `bits` things each. */
  void noteGroups(std::size_t part, std::span<const std::uint8_t> selected, unsigned bits);

  bool Grouped;
  MeshColumns Columns;
  Selections All;
  std::vector<const Selection*> Parts; ///< null: everywhere
  std::vector<SourceKind> Kinds;       ///< of the parts
  bool Prepared = false;
  std::vector<std::uint8_t> Selected; ///< of the block
  std::vector<std::uint8_t> Inner;    ///< the same between two cells
  std::vector<std::uint8_t> More;     ///< of one of the selections
  std::vector<std::int32_t> Groups;   ///< of the block, if these are asked for; -1: none
};

} // namespace smg
