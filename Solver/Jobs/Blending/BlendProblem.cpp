// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Blending/BlendProblem.h"

#include "Solver/Assembly/CellGradients.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smg
{

BlendProblem::BlendProblem(const BlendDescription& description, const StreamInfo& mesh)
  : OfMesh(mesh, "blend")
  , Blended(description, mesh, this->OfMesh)
  , Patches(description.patch, this->OfMesh)
  , Open(this->Patches, this->Blended.components())
  , Steps(this->Blended.specs())
  , Held(description.hold, false, this->OfMesh)
  , Check(mesh.cellType)
  , Anchor(description.anchor)
{
  this->Low.fill(std::numeric_limits<double>::max());
  this->High.fill(std::numeric_limits<double>::lowest());
  if (!(this->Anchor >= 0.0 && std::isfinite(this->Anchor)))
  {
    this->OfMesh.fail("anchor", "must be a finite number of at least 0");
  }
}

void BlendProblem::prepare(const MeshBlock& block, const std::filesystem::path& scratch)
{
  this->Check.add(block);
  for (std::size_t k = 0; k < block.positions.size(); ++k)
  {
    this->Low[k % 3] = std::min(this->Low[k % 3], block.positions[k]);
    this->High[k % 3] = std::max(this->High[k % 3], block.positions[k]);
  }
  this->Patches.prepare(block, scratch);
  this->Held.prepare(block, scratch);
}

void BlendProblem::endPreparing()
{
  this->Patches.endPreparing();
  this->Held.endPreparing(false);
  const Vector diagonal = difference(this->High.data(), this->Low.data());
  const double squared = dot(diagonal, diagonal);
  // Cells of a mesh without extent have no weight.
  this->Screening = squared > 0.0 ? this->Anchor / squared : 0.0;
}

void BlendProblem::addTo(PatchGradients& gradients, const MeshBlock& block)
{
  this->Blended.read(block, this->Open.startBlock(block));
  gradients.add(block, this->Open);
}

void BlendProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  const std::span<double> values = this->Open.startBlock(block);
  this->Blended.read(block, values);
  if (this->Originals)
  {
    this->Originals->append(values);
  }
  if (this->Gradients)
  {
    this->Gradients->startBlock(block);
  }
  std::ranges::fill(conditions.screening, this->Screening);
  const std::span<const std::uint8_t> held = this->Held.at(block);
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    conditions.dirichlet[i] = held[i] ? 0 : -1;
  }
}

void BlendProblem::cells(CellBatch& batch)
{
  const auto corners = static_cast<std::size_t>(cornersOf(batch.type));
  const auto columns = static_cast<std::size_t>(this->columns());
  for (std::size_t c = 0; c < batch.cells(); ++c)
  {
    const auto corner = batch.corners.subspan(c * corners, corners);
    if (this->Open.inOnePatch(corner))
    {
      continue;
    }
    this->Steps.add(corner, this->Open);
    if (batch.measure[c] == 0.0)
    {
      continue; // degenerate: without weight, and without a gradient
    }
    const double* point[4] = {};
    const double* value[4] = {};
    for (std::size_t k = 0; k < corners; ++k)
    {
      point[k] = batch.point(c, static_cast<int>(k));
      value[k] = this->Open.at(corner[k]);
    }
    this->Mean.assign(3 * columns, 0.0);
    if (this->Gradients)
    {
      this->Gradients->average(corner, this->Mean);
    }
    const CellGradients gradients(batch.type, point);
    for (std::size_t k = 0; k < columns; ++k)
    {
      const Vector gradient = gradients.of(batch.type, value, static_cast<int>(k));
      for (std::size_t d = 0; d < 3; ++d)
      {
        batch.field[3 * (c * columns + k) + d] = this->Mean[3 * k + d] - gradient[d];
      }
    }
  }
}

} // namespace smg
