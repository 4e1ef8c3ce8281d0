// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/DiscretisationError.h"

#include <algorithm>
#include <utility>

// The estimate of the discretisation error by the jumps of fluxes; the header has the formula. Each
// facet collects R and s of its cells until its lowest vertex is final, when all of them are known,
// and then contributes to the error. R comes from the weights of the cell, which the solve has,
// too, in a constant number of steps per cell.

namespace smg
{

DiscretisationError::DiscretisationError(
  Pool& pool, const StreamInfo& info, Problem& problem, ReadValues readValues)
  : Type(info.cellType)
  , Columns(static_cast<std::size_t>(problem.columns()))
  , Read(std::move(readValues))
  , Check(info.cellType)
  , Vertices(pool, problem)
  , Weighted(info.cellType, problem)
  , Facets(pool)
  , Terms(pool, problem.columns() + 2)
{
  if (problem.hasFacets())
  {
    this->Conditions.emplace(pool, problem, this->Type, this->Vertices);
  }
}

void DiscretisationError::add(const MeshBlock& block)
{
  this->Check.add(block);
  this->addVertices(block);
  this->Weighted.forEach(block, this->Vertices,
    [this](const WeightedCell& cell)
    {
      if (cell.weights.measure > 0.0)
      {
        this->addCell(cell);
      }
    });
  if (this->Conditions)
  {
    this->Conditions->add(block);
  }
  this->finalize(block.finalized);
}

/** Asks for the conditions at the vertices of a block, and puts the solution in the place of their
 * values. */
void DiscretisationError::addVertices(const MeshBlock& block)
{
  const std::int64_t begin = this->Vertices.end();
  this->Vertices.add(block);
  const std::int64_t end = this->Vertices.end();
  this->Facets.extend(end);
  if (this->Conditions)
  {
    this->Conditions->extend(end);
  }
  this->Values.resize(static_cast<std::size_t>(end - begin) * this->Columns);
  this->Read(begin, end - begin, this->Values);
  std::ranges::copy(this->Values, this->Vertices.values.at(begin));
}

/** Adds the energy in a cell, and its R and s to each of its facets. */
void DiscretisationError::addCell(const WeightedCell& cell)
{
  const int count = cornersOf(this->Type);
  std::int32_t slots[4] = {};
  for (int k = 0; k < count; ++k)
  {
    slots[k] = this->termsOf(facetOf(this->Type, cell.nodes, k).vertex);
  }
  // Pointers only now: each call of termsOf() may have moved the terms.
  double conductance[4] = {};
  double* terms[4] = {};
  for (int k = 0; k < count; ++k)
  {
    terms[k] = this->Terms.at(slots[k]);
  }
  const CellWeights stiffness = cell.stiffness();
  for (int e = 0; e < edgesOf(this->Type); ++e)
  {
    const int i = edgeCorners(this->Type, e)[0], j = edgeCorners(this->Type, e)[1];
    const double weight = stiffness.weight[e];
    conductance[i] += weight;
    conductance[j] += weight;
    const double* a = this->Vertices.values.at(cell.corners[i]);
    const double* b = this->Vertices.values.at(cell.corners[j]);
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      const double step = b[k] - a[k];
      // R_i gains w_ij (u_j - u_i), and R_j the opposite.
      this->Sums.solution += weight * step * step;
      terms[i][k] += weight * step;
      terms[j][k] -= weight * step;
    }
  }
  for (int k = 0; k < count; ++k)
  {
    // Positive in exact arithmetic; rounding may make it negative in a flat cell.
    terms[k][this->Columns] += std::max(0.0, conductance[k]);
    terms[k][this->Columns + 1] += 1.0;
  }
  if (cell.data)
  {
    // The flux is K grad u - q: the integral of q . grad phi_k is what q contributes to R_k.
    addFieldLoads(cell, this->Type, static_cast<int>(this->Columns), terms);
  }
}

/** The slot with the terms of the facet with these corners in ascending order; zeroed if the facet
 * is new. May move all terms. */
std::int32_t DiscretisationError::termsOf(const std::int64_t* corners)
{
  // Taken in case that the facet is new, else given back: one search is enough.
  const std::int32_t fresh = this->Terms.take();
  const std::int32_t slot = this->Facets.join(
    corners[0], corners[1], this->Type == CellType::Triangle ? 0 : corners[2], fresh);
  if (slot == fresh)
  {
    std::fill_n(this->Terms.at(slot), this->Columns + 2, 0.0);
  }
  else
  {
    this->Terms.give(fresh);
  }
  return slot;
}

/** Subtracts the prescribed inflow through boundary facets whose lowest corner is `vertex` from
 * their R: on the boundary, the flux should equal it. */
void DiscretisationError::addInflows(std::int64_t vertex)
{
  const int count = BoundaryFacet::cornersOf(this->Type);
  this->Conditions->take(vertex,
    [&](const BoundaryFacet& facet, double area)
    {
      if (facet.flux < 0 && facet.robin < 0)
      {
        return;
      }
      double* terms = this->Terms.at(this->termsOf(facet.corners));
      // An equal share of the flow for each corner, over d, which is the number of corners of a
      // facet: the flux is d R.
      const double share = area / count / count;
      for (int c = 0; c < count; ++c)
      {
        const double* u = this->Vertices.values.at(facet.vertices[c]);
        for (std::size_t k = 0; k < this->Columns; ++k)
        {
          const std::size_t at = static_cast<std::size_t>(c) * this->Columns + k;
          terms[k] -= facet.flux >= 0 ? share * facet.fluxValue[at] : 0.0;
          terms[k] -=
            facet.robin >= 0 ? share * facet.coefficient[c] * (facet.ambient[at] - u[k]) : 0.0;
        }
      }
    });
}

bool DiscretisationError::isPrescribed(
  std::int64_t low, std::int64_t middle, std::int64_t high) const
{
  const Ring<std::int32_t>& dirichlet = this->Vertices.dirichlet;
  return dirichlet[low] >= 0 && dirichlet[middle] >= 0 &&
         (this->Type == CellType::Triangle || dirichlet[high] >= 0);
}

/** Adds the error at all facets whose lowest vertex is below `final`, and need not wait: all their
 * cells and inflows are known. */
void DiscretisationError::finalize(std::int64_t final)
{
  const std::int64_t end = this->Vertices.ties.closable(final);
  const double dimension = cornersOf(this->Type) - 1;
  for (; this->Final < end; ++this->Final)
  {
    if (this->Conditions)
    {
      this->addInflows(this->Final);
    }
    this->Facets.take(this->Final,
      [&](std::int64_t middle, std::int64_t high, std::int32_t slot)
      {
        const double* terms = this->Terms.at(slot);
        const double cells = terms[this->Columns + 1];
        // Boundary facets with prescribed corners have any flux. Those of cells without weight have
        // no terms but perhaps an inflow: 0 cells.
        if (cells > 1.0 || (cells > 0.0 && !this->isPrescribed(this->Final, middle, high)))
        {
          const double sum = terms[this->Columns];
          // 1 over the mean of s.
          const double resistance = sum > 0.0 ? cells / sum : 0.0;
          for (std::size_t k = 0; k < this->Columns; ++k)
          {
            this->Sums.error += dimension / 12.0 * resistance * terms[k] * terms[k];
          }
        }
        this->Terms.give(slot);
      });
  }
  // Facets need corners from the lowest one on, which is not final yet.
  this->Vertices.release(this->Final, this->Final);
  this->Facets.release(this->Final);
  if (this->Conditions)
  {
    this->Conditions->release(this->Final);
  }
}

EnergySquares DiscretisationError::finish()
{
  this->finalize(this->Vertices.end());
  return this->Sums;
}

} // namespace smg
