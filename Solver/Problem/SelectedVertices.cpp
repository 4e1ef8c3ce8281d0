// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/SelectedVertices.h"

#include "Solver/Problem/Selection.h"
#include "Solver/Problem/VertexSetFile.h"

namespace smg
{

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
