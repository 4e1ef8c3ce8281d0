// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/DistanceSources.h"

#include <algorithm>
#include <functional>
#include <variant>

// The sources of a distance, as selections of the mesh (Solver/Problem/Selection.h), evaluated
// while the mesh is cut into chunks or its walls are collected. The mesh is read once more
// beforehand only if a selection needs that. Otherwise the same reading also tells, at its end,
// whether every selection has found something.

namespace smg
{

DistanceSources::DistanceSources(const std::vector<Where>& from, DataPlace place, bool grouped,
  const StreamInfo& mesh, const std::string& name, Pool& memory, const std::string& key)
  : Grouped(grouped)
  , Columns(mesh, name, &memory)
  , All(this->Columns)
{
  // For the column of sources, which names them by their numbers in the original file.
  this->Columns.requireIds();
  for (std::size_t k = 0; k < from.size(); ++k)
  {
    this->Parts.push_back(
      this->All.add(from[k], place, ColumnOwner::Vertices, key + "[" + std::to_string(k) + "]"));
    this->Kinds.push_back(pointsOf(from[k]) > 0 ? PointSource : RegionSource);
  }
}

std::unique_ptr<MeshSource> DistanceSources::read(const StoredMesh& mesh) const
{
  return mesh.source(this->Columns.vertexColumns(), this->Columns.cellColumns());
}

/** All selections take part in the reading, also those that do not need it: so that the next
 * reading finds all of them prepared. */
void DistanceSources::prepare(const StoredMesh& mesh, const std::filesystem::path& scratch)
{
  if (!this->All.needPreparing())
  {
    return;
  }
  const std::unique_ptr<MeshSource> source = this->read(mesh);
  for (MeshBlock block; source->next(block);)
  {
    this->All.prepare(block, scratch);
  }
  // Prepared is still false: this reports empty selections.
  this->finish();
  this->Prepared = true;
}

void DistanceSources::start(const MeshBlock& block)
{
  // Without a reading beforehand, this one counts what is selected; no such selection needs a
  // scratch file.
  this->Prepared ? this->All.startBlock(block) : this->All.prepare(block, {});
}

void DistanceSources::noteGroups(
  std::size_t part, std::span<const std::uint8_t> selected, unsigned bits)
{
  for (std::size_t k = 0; this->Grouped && k < this->Groups.size(); ++k)
  {
    if (this->Groups[k] < 0 && (selected[k / bits] >> k % bits & 1U) != 0)
    {
      this->Groups[k] = static_cast<std::int32_t>(part);
    }
  }
}

/** The union of the selections. */
std::span<const std::uint8_t> DistanceSources::verticesAt(const MeshBlock& block)
{
  this->start(block);
  this->Selected.assign(static_cast<std::size_t>(block.vertices()), 0);
  this->Groups.assign(this->Grouped ? this->Selected.size() : 0, -1);
  for (std::size_t k = 0; k < this->Parts.size(); ++k)
  {
    const SourceKind kind = this->Kinds[k];
    if (!this->Parts[k])
    {
      std::ranges::fill(this->Selected, kind);
      this->noteGroups(k, this->Selected, 1);
      continue;
    }
    this->noteGroups(k, this->Parts[k]->atVertices(), 1);
    std::ranges::transform(this->Selected, this->Parts[k]->atVertices(), this->Selected.begin(),
      [kind](std::uint8_t before, std::uint8_t isHere) -> std::uint8_t
      { return isHere ? before | kind : before; });
  }
  return this->Selected;
}

/** The union of the selections; interior facets are included, and are sorted out by the caller. */
std::span<const std::uint8_t> DistanceSources::facetsAt(const MeshBlock& block)
{
  this->start(block);
  const auto corners = static_cast<unsigned>(cornersOf(this->Columns.cellType()));
  this->Selected.assign(block.corners.size() / corners, 0);
  this->Inner.assign(this->Selected.size(), 0);
  this->More.resize(this->Selected.size());
  // Without any place, all of the wall is of one.
  this->Groups.assign(
    this->Grouped ? corners * this->Selected.size() : 0, this->Parts.empty() ? 0 : -1);
  for (std::size_t k = 0; k < this->Parts.size(); ++k)
  {
    if (!this->Parts[k])
    {
      std::ranges::fill(this->More, static_cast<std::uint8_t>((1U << corners) - 1U));
    }
    else
    {
      this->Parts[k]->atInnerFacets({ block, 0, block.corners }, this->More);
      std::ranges::transform(this->Inner, this->More, this->Inner.begin(), std::bit_or<>());
      this->Parts[k]->atFacets({ block, 0, block.corners }, this->More);
    }
    this->noteGroups(k, this->More, corners);
    std::ranges::transform(this->Selected, this->More, this->Selected.begin(), std::bit_or<>());
  }
  return this->Selected;
}

std::int64_t DistanceSources::numberOf(const MeshBlock& block, std::size_t i) const
{
  const Column* ids = this->Columns.ids(block);
  return ids ? ids->as<std::int64_t>()[i] : block.firstVertex + static_cast<std::int64_t>(i);
}

/** After a reading beforehand, empty selections have been reported already. */
void DistanceSources::finish()
{
  if (!this->Prepared)
  {
    this->All.endPreparing(nullptr);
  }
}

} // namespace smg
