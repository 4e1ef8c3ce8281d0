// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/CellResults.h"

#include "Solver/Assembly/CellGradients.h"

#include <algorithm>

namespace smg
{

CellResults::CellResults(CellType type, int columns, bool gradient, bool flux)
  : Type(type)
  , Columns(columns)
  , WantsGradient(gradient)
  , WantsFlux(flux)
  , Energy(static_cast<std::size_t>(columns))
  , LeftOut(static_cast<std::size_t>(columns))
{
}

void CellResults::begin(std::size_t cells)
{
  const std::size_t numbers = 3 * cells * static_cast<std::size_t>(this->Columns);
  this->Gradient.assign(this->WantsGradient ? numbers : 0, 0.0);
  this->Flux.assign(this->WantsFlux ? numbers : 0, 0.0);
}

void CellResults::add(std::size_t c, const double* const* points, const double* const* values,
  const CellWeights& weights, double flatness, const double* K)
{
  for (int k = 0; k < this->Columns; ++k)
  {
    double twice = 0.0;
    for (int e = 0; e < edgesOf(this->Type); ++e)
    {
      const int* ends = edgeCorners(this->Type, e);
      const double step = values[ends[0]][k] - values[ends[1]][k];
      twice += weights.weight[e] * step * step;
    }
    this->Energy[static_cast<std::size_t>(k)] += 0.5 * twice;
    this->LeftOut[static_cast<std::size_t>(k)] += 0.5 * (1.0 - flatness) * twice;
  }
  if (!this->WantsGradient && !this->WantsFlux)
  {
    return;
  }
  const CellGradients gradients(this->Type, points);
  for (int k = 0; k < this->Columns; ++k)
  {
    const std::size_t place =
      3 * (c * static_cast<std::size_t>(this->Columns) + static_cast<std::size_t>(k));
    const Vector gradient = gradients.of(this->Type, values, k);
    if (this->WantsGradient)
    {
      std::ranges::copy(gradient, this->Gradient.begin() + static_cast<std::ptrdiff_t>(place));
    }
    if (this->WantsFlux)
    {
      const Vector flux = scaled(-1.0, K ? product(K, gradient) : gradient);
      std::ranges::copy(flux, this->Flux.begin() + static_cast<std::ptrdiff_t>(place));
    }
  }
}

} // namespace smg
