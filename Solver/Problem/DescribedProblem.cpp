// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DescribedProblem.h"

#include "Solver/Problem/ProblemOnMesh.h"

namespace smg
{

DescribedProblem::DescribedProblem(
  const ProblemDescription& description, const StreamInfo& mesh, const std::string& name)
  : OnMesh(std::make_unique<ProblemOnMesh>(description, mesh, name))
{
}

DescribedProblem::~DescribedProblem() = default;

std::vector<std::string> DescribedProblem::vertexColumns() const
{
  return this->OnMesh->vertexColumns();
}

std::vector<std::string> DescribedProblem::cellColumns() const
{
  return this->OnMesh->cellColumns();
}

void DescribedProblem::prepare(
  MeshSource& mesh, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->OnMesh->prepare(mesh, scratch, memoryLimit);
}

void DescribedProblem::preparePart(
  MeshSource& part, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->OnMesh->preparePart(part, scratch, memoryLimit);
}

std::int64_t DescribedProblem::bytes() const
{
  return this->OnMesh->bytes();
}

void DescribedProblem::endPreparing(MeshParts& parts)
{
  this->OnMesh->endPreparing(&parts);
}

int DescribedProblem::columns() const
{
  return this->OnMesh->columns();
}

Weights DescribedProblem::weights() const
{
  return this->OnMesh->weights();
}

ConditionCounts DescribedProblem::conditionCounts() const
{
  return this->OnMesh->conditionCounts();
}

void DescribedProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  this->OnMesh->conditions(block, conditions);
}

bool DescribedProblem::hasCells() const
{
  return this->OnMesh->hasCells();
}

void DescribedProblem::cells(CellBatch& batch)
{
  this->OnMesh->cells(batch);
}

bool DescribedProblem::hasFacets() const
{
  return this->OnMesh->hasFacets();
}

void DescribedProblem::facets(FacetBatch& batch)
{
  this->OnMesh->facets(batch);
}

} // namespace smg
