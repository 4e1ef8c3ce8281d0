// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DescribedHandles.h"

#include "Solver/Jobs/Deformation/HandlesOnMesh.h"

namespace smg
{

DescribedHandles::DescribedHandles(
  const DeformationDescription& description, const StreamInfo& mesh, const std::string& name)
  : OnMesh(std::make_unique<HandlesOnMesh>(description, mesh, name))
{
}

DescribedHandles::~DescribedHandles() = default;

std::vector<std::string> DescribedHandles::vertexColumns() const
{
  return this->OnMesh->vertexColumns();
}

std::vector<std::string> DescribedHandles::cellColumns() const
{
  return this->OnMesh->cellColumns();
}

void DescribedHandles::prepare(
  MeshSource& mesh, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->OnMesh->prepare(mesh, scratch, memoryLimit);
}

void DescribedHandles::preparePart(
  MeshSource& part, const std::filesystem::path& scratch, std::int64_t memoryLimit)
{
  this->OnMesh->preparePart(part, scratch, memoryLimit);
}

std::int64_t DescribedHandles::bytes() const
{
  return this->OnMesh->bytes();
}

void DescribedHandles::endPreparing(MeshParts& parts)
{
  this->OnMesh->endPreparing(&parts);
}

void DescribedHandles::at(const MeshBlock& block, VertexHandles& handles)
{
  this->OnMesh->at(block, handles);
}

std::vector<std::string> DescribedHandles::notes() const
{
  return this->OnMesh->notes(nullptr);
}

std::vector<std::string> DescribedHandles::notes(MeshParts& parts) const
{
  return this->OnMesh->notes(&parts);
}

} // namespace smg
