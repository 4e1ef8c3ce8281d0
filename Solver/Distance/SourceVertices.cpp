// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distance/SourceVertices.h"

#include "smg/Error.h"

#include <algorithm>

namespace smg
{

SourceVertices::SourceVertices(
  const std::vector<Where>& from, const StreamInfo& mesh, const std::string& name)
  : Columns(mesh, name)
{
  if (from.empty())
  {
    throw Error(name + ": a distance needs at least one source.");
  }
  this->Columns.requireIds();
  for (std::size_t k = 0; k < from.size(); ++k)
  {
    this->Selections.push_back(Selection::make(from[k], DataPlace::Vertices, ColumnOwner::Vertices,
      "from[" + std::to_string(k) + "]", this->Columns));
  }
}

std::unique_ptr<MeshSource> SourceVertices::read(const StoredMesh& mesh) const
{
  return mesh.source(this->Columns.vertexColumns(), this->Columns.cellColumns());
}

void SourceVertices::prepare(const StoredMesh& mesh, const std::filesystem::path& scratch)
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

std::span<const std::uint8_t> SourceVertices::at(const MeshBlock& block)
{
  this->Selected.assign(static_cast<std::size_t>(block.vertices()), 0);
  for (const auto& selection : this->Selections)
  {
    if (!selection)
    {
      std::ranges::fill(this->Selected, 1);
      continue;
    }
    // Without an earlier reading this one tells whether anything is selected.
    this->Prepared ? selection->startBlock(block) : selection->prepare(block, {});
    std::ranges::transform(this->Selected, selection->atVertices(), this->Selected.begin(),
      [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
  }
  return this->Selected;
}

std::int64_t SourceVertices::numberOf(const MeshBlock& block, std::size_t i) const
{
  const Column* ids = this->Columns.ids(block);
  return ids ? ids->as<std::int64_t>()[i] : block.firstVertex + static_cast<std::int64_t>(i);
}

void SourceVertices::finish()
{
  for (const auto& selection : this->Selections)
  {
    if (selection && !this->Prepared)
    {
      selection->endPreparing();
    }
  }
}

} // namespace smg
