// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/Loads.h"

#include "Solver/Assembly/Facets.h"

#include <cstddef>

// What sources, screening, fields and boundary conditions contribute to the diagonal and the
// right-hand side of each row. All terms are lumped: a corner has the same share of the area or
// volume of each cell, and of the length or area of each boundary facet.
//
// Contributions of cells and of facets are summed separately. Cells arrive in the order of the
// stream, but a boundary facet is known only when its lowest vertex is final, at a time that
// depends on the blocks; in one sum, the order of the terms would depend on it, too. The time is
// constant per cell and facet.

namespace smg
{

VertexLoads::VertexLoads(Pool& pool, CellType type, int columns)
  : Type(type)
  , Columns(columns)
  , RowSum(pool)
  , Load(pool, columns)
{
}

void VertexLoads::extend(std::int64_t vertices)
{
  this->RowSum.extend(vertices);
  this->Load.extend(vertices);
}

void VertexLoads::reserve(std::int64_t vertices)
{
  this->RowSum.reserveMore(vertices);
  this->Load.reserveMore(vertices);
}

void VertexLoads::release(std::int64_t first)
{
  this->RowSum.release(first);
  this->Load.release(first);
}

/** The shares of a cell in the screening and sources at its corners, and the integrals of its
 * field. */
void VertexLoads::add(const WeightedCell& cell)
{
  const int count = cornersOf(this->Type);
  this->addJumps(cell);
  if (!cell.data)
  {
    return;
  }
  const double mass = cell.weights.measure / count;
  const double screening = *cell.data->density(ScreeningDensity);
  const double* source = cell.data->density(SourceDensity);
  double* loads[4] = {};
  for (int c = 0; c < count; ++c)
  {
    this->RowSum[cell.nodes[c]] += mass * screening;
    loads[c] = this->Load.at(cell.nodes[c]);
    for (int k = 0; k < this->Columns; ++k)
    {
      const double jump = cell.jumps[c] ? cell.jumps[c][k] : 0.0;
      loads[c][k] += mass * (source[k] - screening * jump);
    }
  }
  addFieldLoads(cell, this->Type, this->Columns, loads);
}

/** What flows along the edges of a cell because of the jumps at its corners: the equations have the
 * values of nodes. */
void VertexLoads::addJumps(const WeightedCell& cell)
{
  const int count = cornersOf(this->Type);
  if (std::all_of(cell.jumps, cell.jumps + count, [](const double* jump) { return !jump; }))
  {
    return;
  }
  const CellWeights stiffness = cell.stiffness();
  for (int e = 0; e < edgesOf(this->Type); ++e)
  {
    const int i = edgeCorners(this->Type, e)[0], j = edgeCorners(this->Type, e)[1];
    double* a = this->Load.at(cell.nodes[i]);
    double* b = this->Load.at(cell.nodes[j]);
    for (int k = 0; k < this->Columns; ++k)
    {
      const double flow = stiffness.weight[e] * ((cell.jumps[j] ? cell.jumps[j][k] : 0.0) -
                                                  (cell.jumps[i] ? cell.jumps[i][k] : 0.0));
      a[k] += flow;
      b[k] -= flow;
    }
  }
}

void VertexLoads::add(const BoundaryFacet& facet, double area, const OpenVertices& vertices, Of of)
{
  const int count = BoundaryFacet::cornersOf(this->Type);
  // (K grad u - q) . n is the flux itself, or coefficient * (ambient - u), of which the term with u
  // goes to the diagonal.
  const double share = area / count;
  for (int c = 0; c < count; ++c)
  {
    double* load = this->Load.at(facet.corners[c]);
    for (int k = 0; facet.flux >= 0 && k < this->Columns; ++k)
    {
      load[k] += share * facet.fluxValue[c * this->Columns + k];
    }
    if (facet.robin < 0)
    {
      continue;
    }
    const double rowSum = share * facet.coefficient[c];
    this->RowSum[facet.corners[c]] += rowSum;
    for (int k = 0; k < this->Columns; ++k)
    {
      const double ambient = facet.ambient[c * this->Columns + k];
      const std::int64_t vertex = facet.vertices[c];
      const double* jump = vertices.ties.jump(vertex);
      load[k] += rowSum * (of == Of::Correction
                              ? vertices.below(ambient, vertex, static_cast<std::size_t>(k))
                              : ambient - (jump ? jump[k] : 0.0));
    }
  }
}

RowLoads::RowLoads(Pool& pool, CellType type, Problem& problem, const OpenVertices& vertices)
  : Vertices(vertices)
  , Load(static_cast<std::size_t>(problem.columns()))
{
  if (problem.hasCells() || vertices.ties.anyJump())
  {
    this->OfCells.emplace(pool, type, problem.columns());
  }
  if (problem.hasFacets())
  {
    this->Facets.emplace(pool, problem, type, vertices);
    this->OfFacets.emplace(pool, type, problem.columns());
  }
}

void RowLoads::extend(std::int64_t vertices)
{
  if (this->OfCells)
  {
    this->OfCells->extend(vertices);
  }
  if (this->Facets)
  {
    this->Facets->extend(vertices);
    this->OfFacets->extend(vertices);
  }
}

void RowLoads::reserve(std::int64_t vertices)
{
  if (this->OfCells)
  {
    // Not the loads on facets: with these, no other thread takes part
    // (CellAssembly::mayPipeline()).
    this->OfCells->reserve(vertices);
  }
}

void RowLoads::addFacets(const MeshBlock& block)
{
  if (this->Facets)
  {
    this->Facets->add(block);
  }
}

void RowLoads::release(std::int64_t first)
{
  if (this->OfCells)
  {
    this->OfCells->release(first);
  }
  if (this->Facets)
  {
    this->Facets->release(first);
    this->OfFacets->release(first);
  }
}

/** When vertex i is the lowest open one, all cells and facets that contribute to it are known: a
 * boundary facet belongs to its lowest corner, which is i or closed. */
double RowLoads::close(std::int64_t i)
{
  if (this->Facets)
  {
    this->addBoundary(i);
  }
  double rowSum = this->Vertices.sumDensities(i, this->Load);
  // Always in this order: vertex, cells, facets.
  const auto add = [&](const VertexLoads& loads)
  {
    rowSum += loads.rowSum(i);
    for (std::size_t k = 0; k < this->Load.size(); ++k)
    {
      this->Load[k] += loads.load(i)[k];
    }
  };
  if (this->OfCells)
  {
    add(*this->OfCells);
  }
  // What a solution leaves of the sources beside screening; facets have done the same.
  for (std::size_t k = 0; this->Vertices.isSolved() && rowSum > 0.0 && k < this->Load.size(); ++k)
  {
    this->Load[k] += rowSum * this->Vertices.below(0.0, i, k);
  }
  if (this->OfFacets)
  {
    add(*this->OfFacets);
  }
  return rowSum;
}

/**
 * Adds the contributions of the boundary facets with the lowest corner i to all of their corners.
 */
void RowLoads::addBoundary(std::int64_t i)
{
  this->Facets->take(i,
    [this](const BoundaryFacet& facet, double area)
    {
      this->OfFacets->add(facet, area, this->Vertices,
        this->Vertices.isSolved() ? VertexLoads::Of::Correction : VertexLoads::Of::Problem);
    });
}

} // namespace smg
