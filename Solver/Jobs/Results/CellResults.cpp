// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/CellResults.h"

#include "Solver/Assembly/Elements.h"

#include <algorithm>
#include <cstddef>
#include <utility>

// What the cells make of a solution: gradients, fluxes and energy, and their sums over parts and
// groups, taken in the order of the stream.

namespace smg
{

CellResults::CellResults(
  CellType type, int columns, bool gradient, bool flux, int parts, IntegratedParts integrated)
  : Type(type)
  , Columns(columns)
  , WantsGradient(gradient)
  , WantsFlux(flux)
  , Energy(static_cast<std::size_t>(columns))
  , LeftOut(static_cast<std::size_t>(columns))
  , OfCell(static_cast<std::size_t>(columns))
  , Integrated(std::move(integrated))
{
  const std::vector<double> zeros(3 * static_cast<std::size_t>(columns));
  this->Parts.assign(parts > 0 ? static_cast<std::size_t>(parts) + 1 : 0, { 0.0, zeros, zeros });
  const std::vector<double> value(static_cast<std::size_t>(columns));
  this->Integrals.assign(this->Integrated.names.size(), { { 0.0, zeros, zeros }, value });
}

void CellResults::begin(const MeshBlock& block)
{
  const std::size_t numbers =
    3 * cellsOf(this->Type, block) * static_cast<std::size_t>(this->Columns);
  const std::ptrdiff_t groups =
    this->Integrals.empty() ? -1
                            : findColumn(block.cellColumns,
                                MeshGroups::columnSpec(GroupOf::Cells, cornersOf(this->Type)));
  this->Sets = groups < 0 ? std::span<const GroupSet>()
                          : block.cellColumns[static_cast<std::size_t>(groups)].as<GroupSet>();
  this->Gradient.assign(this->WantsGradient ? numbers : 0, 0.0);
  this->Flux.assign(this->WantsFlux ? numbers : 0, 0.0);
}

/** The mean of the corners is exact for a linear function. */
void CellResults::integrate(const WeightedCell& cell, const double* const* values)
{
  if (this->Integrals.empty())
  {
    return;
  }
  const int corners = cornersOf(this->Type);
  for (const std::uint32_t part : this->partsOf(cell))
  {
    IntegralSums& sums = this->Integrals[part];
    for (std::size_t k = 0; k < sums.value.size(); ++k)
    {
      double sum = 0.0;
      for (int c = 0; c < corners; ++c)
      {
        sum += values[c][k];
      }
      sums.value[k] += cell.weights.measure * (sum / corners);
    }
  }
}

/** Adds the energy of a cell by its weights, 1/2 the sum of w_ij (u_i - u_j)^2 over the edges,
 * which holds for any K; gradients are computed only if they are wanted. */
void CellResults::add(const WeightedCell& cell, const double* const* values)
{
  for (int k = 0; k < this->Columns; ++k)
  {
    double twice = 0.0;
    for (int e = 0; e < edgesOf(this->Type); ++e)
    {
      const int* ends = edgeCorners(this->Type, e);
      const double step = values[ends[0]][k] - values[ends[1]][k];
      twice += cell.weights.weight[e] * step * step;
    }
    this->OfCell[static_cast<std::size_t>(k)] = 0.5 * twice;
    this->Energy[static_cast<std::size_t>(k)] += 0.5 * twice;
    this->LeftOut[static_cast<std::size_t>(k)] += 0.5 * (1.0 - cell.flatness) * twice;
  }
  this->Into.clear();
  if (!this->Parts.empty())
  {
    const std::int32_t part = cell.data ? cell.data->part() : -1;
    this->Into.push_back(
      part >= 0 ? &this->Parts[static_cast<std::size_t>(part)] : &this->Parts.back());
  }
  for (std::size_t k = 0; !this->Integrals.empty() && k < this->partsOf(cell).size(); ++k)
  {
    this->Into.push_back(&this->Integrals[this->partsOf(cell)[k]].part);
  }
  if (!this->WantsGradient && !this->WantsFlux && this->Into.empty())
  {
    return;
  }
  const double measure = cell.weights.measure;
  const double* K = cell.data ? cell.data->conductivity() : nullptr;
  std::ranges::for_each(this->Into, [measure](PartSums* sums) { sums->measure += measure; });
  const CellGradients gradients(this->Type, cell.points);
  for (int k = 0; k < this->Columns; ++k)
  {
    const std::size_t place =
      3 * (cell.number * static_cast<std::size_t>(this->Columns) + static_cast<std::size_t>(k));
    const Vector gradient = gradients.of(this->Type, values, k);
    if (this->WantsGradient)
    {
      std::ranges::copy(gradient, this->Gradient.begin() + static_cast<std::ptrdiff_t>(place));
    }
    if (!this->WantsFlux && this->Into.empty())
    {
      continue; // then K is not known
    }
    const Vector flux = scaled(-1.0, K ? product(K, gradient) : gradient);
    if (this->WantsFlux)
    {
      std::ranges::copy(flux, this->Flux.begin() + static_cast<std::ptrdiff_t>(place));
    }
    for (PartSums* sums : this->Into)
    {
      for (std::size_t d = 0; d < 3; ++d)
      {
        const std::size_t number = 3 * static_cast<std::size_t>(k) + d;
        sums->gradient[number] += measure * gradient[d];
        sums->flux[number] += measure * flux[d];
      }
    }
  }
}

} // namespace smg
