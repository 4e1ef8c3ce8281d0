// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/DescribedMesh.h"

namespace smg::testing
{
namespace
{

template <class T>
void append(std::vector<T>& all, const std::vector<T>& some)
{
  all.insert(all.end(), some.begin(), some.end());
}

void askVertices(Problem& problem, const MeshBlock& block, ProblemAnswers& all)
{
  const auto vertices = static_cast<std::size_t>(block.vertices());
  const auto columns = static_cast<std::size_t>(problem.columns());
  VertexConditions some;
  some.dirichlet.assign(vertices, -1);
  some.value.assign(vertices * columns, 0.0);
  some.source.assign(vertices * columns, 0.0);
  some.screening.assign(vertices, 0.0);
  problem.conditions(block, some);
  append(all.vertices.dirichlet, some.dirichlet);
  append(all.vertices.value, some.value);
  append(all.vertices.source, some.source);
  append(all.vertices.screening, some.screening);
}

void askCells(Problem& problem, CellType type, const MeshBlock& block, std::size_t first,
  std::size_t cells, ProblemAnswers& all)
{
  const auto columns = static_cast<std::size_t>(problem.columns());
  const auto corners = static_cast<std::size_t>(cornersOf(type));
  const std::span<const std::int64_t> those(
    block.corners.data() + first * corners, cells * corners);
  // A scalar conductivity does not depend on the positions of the corners.
  const std::vector<double> points(3 * cells * corners, 0.0);
  std::vector<double> weight(cells * static_cast<std::size_t>(edgesOf(type)), 1.0);
  std::vector<double> measure(cells, 1.0), screening(cells), source(cells * columns);
  std::vector<double> field(3 * cells * columns), conductivity;
  for (std::size_t c = 0; c < cells; ++c)
  {
    append(conductivity, { 1.0, 1.0, 1.0, 0.0, 0.0, 0.0 });
  }
  std::vector<std::int32_t> part(cells, -1);
  CellBatch batch{ type, block, first, those, points, weight, measure, screening, source, field,
    conductivity, part };
  problem.cells(batch);
  append(all.weight, weight);
  append(all.screening, screening);
  append(all.source, source);
  append(all.field, field);
  append(all.conductivity, conductivity);
}

void askFacets(Problem& problem, CellType type, const MeshBlock& block, std::size_t first,
  std::size_t cells, ProblemAnswers& all)
{
  const auto columns = static_cast<std::size_t>(problem.columns());
  const auto corners = static_cast<std::size_t>(cornersOf(type));
  const std::span<const std::int64_t> those(
    block.corners.data() + first * corners, cells * corners);
  const std::size_t facets = cells * corners;
  std::vector<std::int32_t> flux(facets, -1), robin(facets, -1);
  std::vector<double> fluxValue(facets * (corners - 1) * columns);
  std::vector<double> coefficient(facets * (corners - 1)), ambient(fluxValue.size());
  FacetBatch batch{ type, block, first, those, flux, fluxValue, robin, coefficient, ambient };
  problem.facets(batch);
  append(all.flux, flux);
  append(all.robin, robin);
  append(all.fluxValue, fluxValue);
  append(all.coefficient, coefficient);
  append(all.ambient, ambient);
}

} // namespace

ProblemAnswers answersOf(Problem& problem, MeshSource& mesh, std::size_t batch)
{
  const CellType type = mesh.info().cellType;
  ProblemAnswers all;
  for (MeshBlock block; mesh.next(block);)
  {
    askVertices(problem, block, all);
    const std::size_t cells = block.corners.size() / static_cast<std::size_t>(cornersOf(type));
    for (std::size_t first = 0; first < cells; first += batch)
    {
      const std::size_t count = std::min(batch, cells - first);
      if (problem.hasCells())
      {
        askCells(problem, type, block, first, count, all);
      }
      if (problem.hasFacets())
      {
        askFacets(problem, type, block, first, count, all);
      }
    }
  }
  return all;
}

} // namespace smg::testing
