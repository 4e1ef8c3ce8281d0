// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/DistanceSources.h"

#include <algorithm>
#include <functional>

namespace smg
{

DistanceSources::DistanceSources(const std::vector<Where>& from, DataPlace place,
  const StreamInfo& mesh, const std::string& name, Pool& memory)
  : Columns(mesh, name, &memory)
{
  this->Columns.requireIds();
  for (std::size_t k = 0; k < from.size(); ++k)
  {
    this->Selections.push_back(Selection::make(
      from[k], place, ColumnOwner::Vertices, "from[" + std::to_string(k) + "]", this->Columns));
  }
}

std::unique_ptr<MeshSource> DistanceSources::read(const StoredMesh& mesh) const
{
  return mesh.source(this->Columns.vertexColumns(), this->Columns.cellColumns());
}

void DistanceSources::prepare(const StoredMesh& mesh, const std::filesystem::path& scratch)
{
  const auto needsPreparing = [](const std::unique_ptr<Selection>& selection)
  { return selection && selection->needsPreparing(); };
  if (std::ranges::none_of(this->Selections, needsPreparing))
  {
    return;
  }
  const std::unique_ptr<MeshSource> source = this->read(mesh);
  for (MeshBlock block; source->next(block);)
  {
    for (const auto& selection : this->Selections)
    {
      if (selection)
      {
        selection->prepare(block, scratch);
      }
    }
  }
  this->finish();
  this->Prepared = true;
}

void DistanceSources::start(Selection& selection, const MeshBlock& block) const
{
  // Without an earlier reading this one tells whether anything is selected.
  this->Prepared ? selection.startBlock(block) : selection.prepare(block, {});
}

std::span<const std::uint8_t> DistanceSources::verticesAt(const MeshBlock& block)
{
  this->Selected.assign(static_cast<std::size_t>(block.vertices()), 0);
  for (const auto& selection : this->Selections)
  {
    if (!selection)
    {
      std::ranges::fill(this->Selected, 1);
      continue;
    }
    this->start(*selection, block);
    std::ranges::transform(
      this->Selected, selection->atVertices(), this->Selected.begin(), std::bit_or<>());
  }
  return this->Selected;
}

std::span<const std::uint8_t> DistanceSources::facetsAt(const MeshBlock& block)
{
  const auto corners = static_cast<unsigned>(cornersOf(this->Columns.cellType()));
  this->Selected.assign(block.corners.size() / corners, 0);
  this->More.resize(this->Selected.size());
  for (const auto& selection : this->Selections)
  {
    if (!selection)
    {
      std::ranges::fill(this->Selected, static_cast<std::uint8_t>((1U << corners) - 1U));
      continue;
    }
    this->start(*selection, block);
    selection->atFacets({ block, 0, block.corners }, this->More);
    std::ranges::transform(this->Selected, this->More, this->Selected.begin(), std::bit_or<>());
  }
  return this->Selected;
}

std::int64_t DistanceSources::numberOf(const MeshBlock& block, std::size_t i) const
{
  const Column* ids = this->Columns.ids(block);
  return ids ? ids->as<std::int64_t>()[i] : block.firstVertex + static_cast<std::int64_t>(i);
}

void DistanceSources::finish()
{
  for (const auto& selection : this->Selections)
  {
    if (selection && !this->Prepared)
    {
      selection->endPreparing(nullptr);
    }
  }
}

} // namespace smg
