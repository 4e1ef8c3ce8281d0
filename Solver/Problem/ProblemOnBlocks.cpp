// SPDX-License-Identifier: BSD-3-Clause
// Evaluation of a described problem on a block of its mesh.
#include "Solver/Problem/ProblemOnMesh.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>

namespace smg
{

void ProblemOnMesh::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  for (DatumOnMesh* datum : this->data())
  {
    if (datum->needsPreparing())
    {
      throw Error(
        "Nearest vertices, the vertices of cells and the boundary are found by a previous reading "
        "of the mesh: call DescribedProblem::prepare().");
    }
    datum->startBlock(block);
  }
  this->setValues(block, conditions);
  if (this->SourcePlace == DataPlace::Vertices)
  {
    this->setDensity(this->Source, block, conditions.source);
  }
  if (this->ScreeningPlace == DataPlace::Vertices)
  {
    this->setDensity(this->Screening, block, conditions.screening);
  }
  this->addSoft(block, conditions);
}

void ProblemOnMesh::setValues(const MeshBlock& block, VertexConditions& conditions)
{
  if (this->StartsAtPosition)
  {
    conditions.value = block.positions;
  }
  this->Dirichlet.entriesAtVertices(conditions.dirichlet);
  this->Entry.assign(conditions.dirichlet.size(), -1);
  this->Initial.entriesAtVertices(this->Entry);
  // Initial values of constrained vertices are not used and may be anything, also NaN.
  for (std::size_t i = 0; i < this->Entry.size(); ++i)
  {
    this->Entry[i] = conditions.dirichlet[i] >= 0 ? -1 : this->Entry[i];
  }
  this->Initial.valuesAtVertices(block, this->Entry, conditions.value.data(), this->Columns);
  std::ranges::replace_if(
    conditions.value, [](double value) { return std::isnan(value); }, 0.0);
  this->Dirichlet.valuesAtVertices(
    block, conditions.dirichlet, conditions.value.data(), this->Columns);
}

void ProblemOnMesh::setDensity(
  const DatumOnMesh& datum, const MeshBlock& block, std::vector<double>& density)
{
  const auto vertices = static_cast<std::size_t>(block.vertices());
  this->Entry.assign(vertices, -1);
  datum.entriesAtVertices(this->Entry);
  datum.valuesAtVertices(
    block, this->Entry, density.data(), vertices == 0 ? 0 : density.size() / vertices);
}

void ProblemOnMesh::setDensity(
  const DatumOnMesh& datum, const CellRange& cells, std::span<double> density)
{
  datum.entriesAtCells(cells, this->Entry);
  datum.valuesAtCells(cells, this->Entry, density.data(), density.size() / this->Entry.size());
}

void ProblemOnMesh::addSoft(const MeshBlock& block, VertexConditions& conditions)
{
  const auto vertices = static_cast<std::size_t>(block.vertices());
  std::vector<double> weight;
  for (const Soft& soft : this->Softs)
  {
    this->Entry.assign(vertices, -1);
    soft.value.entriesAtVertices(this->Entry);
    this->Values.resize(vertices * this->Columns);
    soft.value.valuesAtVertices(block, this->Entry, this->Values.data(), this->Columns);
    this->Other.assign(vertices, -1);
    soft.weight.entriesAtVertices(this->Other);
    for (std::size_t i = 0; i < vertices; ++i)
    {
      this->Other[i] = this->Entry[i] >= 0 ? this->Other[i] : -1;
    }
    weight.assign(vertices, 0.0);
    soft.weight.valuesAtVertices(block, this->Other, weight.data(), 1);
    for (std::size_t i = 0; i < vertices; ++i)
    {
      conditions.screening[i] += weight[i];
      for (std::size_t k = i * this->Columns; this->Other[i] >= 0 && k < (i + 1) * this->Columns;
           ++k)
      {
        conditions.source[k] += weight[i] * this->Values[k];
      }
    }
  }
}

void ProblemOnMesh::cells(CellBatch& batch)
{
  const CellRange cells{ batch.block, batch.first, batch.corners };
  this->setConductivity(cells, batch);
  this->setField(cells, batch);
  if (this->SourcePlace == DataPlace::Cells)
  {
    this->Entry.assign(batch.cells(), -1);
    this->setDensity(this->Source, cells, batch.source);
  }
  if (this->ScreeningPlace == DataPlace::Cells)
  {
    this->Entry.assign(batch.cells(), -1);
    this->setDensity(this->Screening, cells, batch.screening);
  }
}

void ProblemOnMesh::setConductivity(const CellRange& cells, CellBatch& batch)
{
  if (!this->Conductivity.isGiven())
  {
    return;
  }
  this->Entry.assign(batch.cells(), -1);
  this->Conductivity.entriesAtCells(cells, this->Entry);
  this->Values.resize(6 * batch.cells());
  this->Conductivity.valuesAtCells(cells, this->Entry, this->Values.data(), 6);
  const auto corners = cornersOf(batch.type);
  for (std::size_t c = 0; c < batch.cells(); ++c)
  {
    if (this->Entry[c] < 0)
    {
      continue;
    }
    const double* numbers = this->Values.data() + 6 * c;
    const int count = this->Conductivity.components(this->Entry[c]);
    const std::span<double> weights = batch.weightsOf(c);
    if (count == 1)
    {
      std::ranges::for_each(weights, [&](double& weight) { weight *= numbers[0]; });
    }
    else
    {
      const std::array<double, 6> tensor = tensorOf(numbers, count);
      std::array<const double*, 4> points{};
      for (int k = 0; k < corners; ++k)
      {
        points[static_cast<std::size_t>(k)] = batch.point(c, k);
      }
      const CellWeights own = conductivityWeights(batch.type, points.data(), tensor.data());
      std::copy_n(own.weight, weights.size(), weights.begin());
    }
    if (!batch.conductivity.empty())
    {
      std::ranges::copy(
        tensorOf(numbers, count), batch.conductivity.begin() + static_cast<std::ptrdiff_t>(6 * c));
    }
  }
}

void ProblemOnMesh::setField(const CellRange& cells, CellBatch& batch)
{
  if (!this->Field.isGiven())
  {
    return;
  }
  const std::size_t numbers = 3 * this->Columns;
  this->Entry.assign(batch.cells(), 0);
  this->Field.valuesAtCells(cells, this->Entry, batch.field.data(), numbers);
  if (this->Field.components(0) == 3)
  {
    // One vector for all columns.
    for (std::size_t c = 0; c < batch.cells(); ++c)
    {
      double* vectors = batch.field.data() + c * numbers;
      for (std::size_t k = 3; k < numbers; ++k)
      {
        vectors[k] = vectors[k - 3];
      }
    }
  }
}

void ProblemOnMesh::facets(FacetBatch& batch)
{
  const CellRange cells{ batch.block, batch.first, batch.corners };
  this->Flux.entriesAtFacets(cells, batch.flux);
  this->Flux.valuesAtFacets(cells, batch.flux, batch.fluxValue.data(), this->Columns);
  this->setRobin(cells, batch);
}

void ProblemOnMesh::setRobin(const CellRange& cells, FacetBatch& batch)
{
  this->Ambient.entriesAtFacets(cells, batch.robin);
  this->Ambient.valuesAtFacets(cells, batch.robin, batch.ambient.data(), this->Columns);
  for (std::size_t k = 0; k < this->Coefficients.size(); ++k)
  {
    this->Entry.assign(batch.robin.size(), -1);
    this->Coefficients[k].entriesAtFacets(cells, this->Entry);
    for (std::size_t facet = 0; facet < batch.robin.size(); ++facet)
    {
      const bool holds = batch.robin[facet] == static_cast<std::int32_t>(k);
      this->Entry[facet] = holds ? this->Entry[facet] : -1;
    }
    this->Coefficients[k].valuesAtFacets(cells, this->Entry, batch.coefficient.data(), 1);
  }
}

} // namespace smg
