// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/ElementProblem.h"

#include <algorithm>

namespace smg::testing
{

ElementProblem::Point ElementProblem::centroid(std::int64_t cell) const
{
  const int size = cornersOf(this->Mesh.cellType);
  Point sum = Point::Zero();
  for (int k = 0; k < size; ++k)
  {
    sum += this->vertex(this->Mesh.corners[size * cell + k]);
  }
  return sum / size;
}

int ElementProblem::dirichletOf(std::int64_t v) const
{
  return this->conditionOf(this->DirichletConditions, { v });
}

bool ElementProblem::hasCells() const
{
  return this->Conductivity || this->CellScreening || this->CellSource || this->CellField;
}

void ElementProblem::cells(CellBatch& batch)
{
  for (std::size_t c = 0; c < batch.cells(); ++c)
  {
    const std::int64_t cell = batch.block.firstCell + static_cast<std::int64_t>(batch.first + c);
    const Point center = this->centroid(cell);
    if (this->Conductivity)
    {
      const Eigen::Matrix3d k = this->Conductivity(center);
      const double tensor[6] = { k(0, 0), k(1, 1), k(2, 2), k(0, 1), k(1, 2), k(0, 2) };
      const double* points[4] = {};
      for (int corner = 0; corner < cornersOf(batch.type); ++corner)
      {
        points[corner] = batch.point(c, corner);
      }
      const smg::CellWeights weights = conductivityWeights(batch.type, points, tensor);
      std::copy_n(weights.weight, edgesOf(batch.type), batch.weightsOf(c).begin());
      if (!batch.conductivity.empty())
      {
        std::copy_n(tensor, 6, batch.conductivity.begin() + static_cast<std::ptrdiff_t>(6 * c));
      }
    }
    if (this->Part)
    {
      batch.part[c] = this->Part(center);
    }
    if (this->CellScreening)
    {
      batch.screening[c] = this->CellScreening(center);
    }
    for (int k = 0; this->CellSource && k < this->Columns; ++k)
    {
      batch.source[c * this->Columns + k] = this->CellSource(center)[k];
    }
    for (int k = 0; this->CellField && k < 3 * this->Columns; ++k)
    {
      batch.field[3 * c * this->Columns + k] = this->CellField(center)(k % 3, k / 3);
    }
  }
}

void ElementProblem::facets(FacetBatch& batch)
{
  const auto corners = static_cast<std::size_t>(cornersOf(batch.type));
  const std::size_t each = corners - 1;
  for (std::size_t facet = 0; facet < batch.flux.size(); ++facet)
  {
    std::vector<std::int64_t> vertices;
    for (std::size_t k = 0; k < corners; ++k)
    {
      if (k != facet % corners)
      {
        vertices.push_back(batch.corners[facet / corners * corners + k]);
      }
    }
    batch.flux[facet] = this->conditionOf(this->FluxConditions, vertices);
    batch.robin[facet] = this->conditionOf(this->RobinConditions, vertices);
    for (std::size_t e = 0; e < each; ++e)
    {
      const std::size_t place = facet * each + e;
      const Point p = this->vertex(vertices[e]);
      for (int k = 0; k < this->Columns; ++k)
      {
        if (batch.flux[facet] >= 0)
        {
          batch.fluxValue[place * this->Columns + k] =
            this->FluxConditions[batch.flux[facet]].value(p)[k];
        }
        if (batch.robin[facet] >= 0)
        {
          const Robin& robin = this->RobinConditions[batch.robin[facet]];
          batch.coefficient[place] = robin.coefficient(p);
          batch.ambient[place * this->Columns + k] = robin.ambient(p)[k];
        }
      }
    }
  }
}

ConditionCounts ElementProblem::conditionCounts() const
{
  return { static_cast<int>(this->DirichletConditions.size()),
    static_cast<int>(this->FluxConditions.size()), static_cast<int>(this->RobinConditions.size()),
    this->Parts };
}

void ElementProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  for (std::int64_t i = 0; i < block.vertices(); ++i)
  {
    const Point p = this->vertex(block.firstVertex + i);
    conditions.dirichlet[i] = this->dirichletOf(block.firstVertex + i);
    const Values& value = conditions.dirichlet[i] >= 0
                            ? this->DirichletConditions[conditions.dirichlet[i]].value
                            : this->Initial;
    for (int k = 0; k < this->Columns; ++k)
    {
      conditions.value[i * this->Columns + k] = value ? value(p)[k] : 0.0;
      conditions.source[i * this->Columns + k] =
        this->VertexSource ? this->VertexSource(p)[k] : 0.0;
    }
    conditions.screening[i] = this->VertexScreening ? this->VertexScreening(p) : 0.0;
  }
}

} // namespace smg::testing
