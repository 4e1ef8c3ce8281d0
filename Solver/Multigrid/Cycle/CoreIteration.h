// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Buffer.h"
#include "Solver/Multigrid/Cycle/Level.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace smg
{

/**
 * Solves the equations of a core level more accurately than one V-cycle does, by conjugate
 * gradients preconditioned by V-cycles from this level on. Each level adds to the error of a
 * V-cycle, so a V-cycle over many levels reduces smooth errors slowly. On a level much smaller than
 * the finest one the iteration takes hardly any time, and it saves V-cycles of the finest level,
 * which are passes.
 *
 * The flexible form permits V-cycles that are not quite symmetric, as with forward Gauss-Seidel
 * (Notay, SIAM Journal on Scientific Computing 22, 2000, 1444-1460). Each column has its own
 * coefficients. It takes four vectors of the level in single precision.
 */
class CoreIteration
{
public:
  using CoreLevel = Level<float>;

  /** When the iteration ends. */
  struct Ending
  {
    int maxCycles = 20;
    /** It ends with the V-cycle that adds at most this share to the squared energy norm of x,
     * for every column: an error of about 3 %. */
    double accuracy = 0.001;
  };

  /** For a level whose nodes are all in memory. */
  CoreIteration(CoreLevel& level, Ending ending)
    : Core(level)
    , End(ending)
    , Size(static_cast<std::size_t>(level.window().x().range(0, level.window().nodes()).size()))
    , Lanes(static_cast<std::size_t>(level.window().stride()))
    , Memory(level.window().pool(), Vectors * this->Size * sizeof(float))
  {
  }

  /** Computes x of the level from its b, which is overwritten; cycle() must compute x from b by
   * a V-cycle. */
  template <class Cycle>
  void operator()(Cycle&& cycle)
  {
    LevelWindow<float>& window = this->Core.window();
    const std::span<float> z = window.x().range(0, window.nodes());
    const std::span<float> r = window.b().range(0, window.nodes());
    const std::span<float> sum = this->vector(0), direction = this->vector(1);
    const std::span<float> image = this->vector(2), residual = this->vector(3);
    std::ranges::fill(this->values(), 0.0F);
    std::vector<double> energy(this->Lanes), reduction(this->Lanes);
    for (int k = 0; k < this->End.maxCycles; ++k)
    {
      // z = M^-1 r. A z comes from r minus the residual after the V-cycle, without another product.
      cycle();
      this->Core.residualAll(residual.data());
      // Energies of the first iteration are 0, so that it has no conjugation.
      const std::vector<double> conjugation = this->ratios(this->dots(z, image), energy);
      for (std::size_t i = 0; i < this->Size; ++i)
      {
        const auto beta = static_cast<float>(conjugation[i % this->Lanes]);
        direction[i] = z[i] - beta * direction[i];
        image[i] = (r[i] - residual[i]) - beta * image[i];
      }
      energy = this->dots(direction, image);
      const std::vector<double> descent = this->dots(direction, r);
      const std::vector<double> length = this->ratios(descent, energy);
      bool isAccurate = true;
      for (std::size_t lane = 0; lane < this->Lanes; ++lane)
      {
        // What this direction adds to the squared energy norm of x.
        const double gain = length[lane] * descent[lane];
        reduction[lane] += gain;
        isAccurate = isAccurate && gain <= this->End.accuracy * reduction[lane];
      }
      for (std::size_t i = 0; i < this->Size; ++i)
      {
        const auto alpha = static_cast<float>(length[i % this->Lanes]);
        sum[i] += alpha * direction[i];
        r[i] -= alpha * image[i];
      }
      if (isAccurate)
      {
        break;
      }
    }
    std::ranges::copy(sum, z.begin());
  }

private:
  static constexpr std::size_t Vectors = 4;

  std::span<float> values()
  {
    return { reinterpret_cast<float*>(this->Memory.data()), Vectors * this->Size };
  }
  std::span<float> vector(std::size_t v)
  {
    return this->values().subspan(v * this->Size, this->Size);
  }

  /** The scalar products of a and b, lane by lane, in double precision and in node order. */
  std::vector<double> dots(std::span<const float> a, std::span<const float> b) const
  {
    std::vector<double> sums(this->Lanes);
    for (std::size_t i = 0; i < this->Size; ++i)
    {
      sums[i % this->Lanes] += static_cast<double>(a[i]) * static_cast<double>(b[i]);
    }
    return sums;
  }
  /** a / b, lane by lane; 0 where b is not positive, as for a column that is zero or solved. */
  static std::vector<double> ratios(std::vector<double> a, const std::vector<double>& b)
  {
    for (std::size_t lane = 0; lane < a.size(); ++lane)
    {
      a[lane] = b[lane] > 0.0 ? a[lane] / b[lane] : 0.0;
    }
    return a;
  }

  CoreLevel& Core;
  Ending End;
  std::size_t Size;
  std::size_t Lanes;
  Buffer Memory;
};

} // namespace smg
