// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/FixedVertices.h"

#include "Solver/Problem/Selection.h"
#include "Solver/Problem/VertexSetFile.h"

#include <string>

namespace smg
{

FixedVertices::FixedVertices(
  const std::vector<Where>& parts, bool findsBoundary, MeshColumns& columns)
  : Memory(columns.memory())
{
  if (findsBoundary)
  {
    this->Boundary = std::make_unique<BoundarySelection>(DataPlace::Vertices, "boundary", columns);
  }
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    auto part = Selection::make(parts[k], DataPlace::Vertices, ColumnOwner::Vertices,
      "hold[" + std::to_string(k) + "]", columns);
    if (part)
    {
      this->Parts.push_back(std::move(part));
    }
    else
    {
      this->HoldsAll = true;
    }
  }
}

void FixedVertices::prepare(const MeshBlock& block, const std::filesystem::path& scratch)
{
  if (this->Boundary)
  {
    this->Boundary->prepare(block, scratch);
  }
  for (const auto& part : this->Parts)
  {
    part->prepare(block, scratch);
  }
}

void FixedVertices::endPreparing(bool fixesBoundary)
{
  this->BoundarySize = this->Boundary ? this->Boundary->finish() : 0;
  if (!fixesBoundary || this->BoundarySize == 0)
  {
    this->Boundary.reset();
  }
  for (const auto& part : this->Parts)
  {
    part->endPreparing(nullptr);
  }
}

std::span<const std::uint8_t> FixedVertices::at(const MeshBlock& block)
{
  this->Held.assign(static_cast<std::size_t>(block.vertices()), this->HoldsAll ? 1 : 0);
  const auto add = [this, &block](Selection& selection)
  {
    selection.startBlock(block);
    const std::span<const std::uint8_t> selected = selection.atVertices();
    for (std::size_t i = 0; i < selected.size(); ++i)
    {
      this->Held[i] |= selected[i];
    }
  };
  for (const auto& part : this->Parts)
  {
    add(*part);
  }
  if (this->Boundary)
  {
    add(*this->Boundary);
  }
  return this->Held;
}

SelectedVertices::SelectedVertices(
  const Where& where, const StreamInfo& mesh, const std::string& name)
  : Columns(mesh, name)
  , Selected(
      Selection::make(where, DataPlace::Vertices, ColumnOwner::Cells, "region", this->Columns))
{
}

SelectedVertices::~SelectedVertices() = default;

void SelectedVertices::add(const MeshBlock& block)
{
  this->Selected->prepare(block, {});
}

void SelectedVertices::finish()
{
  this->Selected->endPreparing(nullptr);
}

bool SelectedVertices::contains(std::int64_t vertex) const
{
  return this->Selected->preparedVertices()->contains(vertex);
}

} // namespace smg
