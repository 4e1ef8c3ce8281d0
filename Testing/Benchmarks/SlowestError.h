// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/DisjointSets.h"
#include "Solver/Multigrid/Cycle/VCycle.h"
#include "Testing/Benchmarks/LevelsInCore.h"
#include "Testing/Support/TestMeshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace smg::benchmark
{

/**
 * What a V-cycle from a level reduces least: power iterations with I - B A on a random error, B
 * being the V-cycle with the program's own kernels. In "two-grid" mode the next level is solved
 * (nearly) exactly, so that only the smoother and the interpolation of this level count.
 */
class SlowestError
{
public:
  explicit SlowestError(LevelsInCore& levels)
    : Levels(levels)
  {
  }

  /** The factor of the energy norm in the last of `iterations` V-cycles from level l. */
  double factor(int l, bool isTwoGrid, int iterations)
  {
    std::vector<Level<float>*> below;
    for (int k = l + 1; k < this->Levels.count(); ++k)
    {
      below.push_back(&this->Levels.coarse(k));
    }
    this->Below.setLevels(std::move(below), 0);
    double last = 0.0;
    this->Levels.with(
      l, [&](auto& level) { last = this->iterate(level, l, isTwoGrid, iterations); });
    return last;
  }

  /** Of each node of the level of the last factor(): the square of what remained of the error. */
  const std::vector<double>& squares() const { return this->Squares; }

  /** The energy of that error relative to what it would be without the neighbours: about 0 for
   * smooth errors, and 1 for rough ones. */
  double roughness() const { return this->Quotient; }

private:
  /** As good as a direct solve for factors of two digits. */
  static constexpr CoreIteration::Ending Exact{ 200, 1e-9 };

  template <class Real>
  double iterate(Level<Real>& level, int l, bool isTwoGrid, int iterations)
  {
    LevelWindow<Real>& window = level.window();
    const auto stride = static_cast<std::size_t>(window.stride());
    const std::span<Real> x = window.x().range(0, window.nodes());
    const std::span<Real> b = window.b().range(0, window.nodes());
    std::vector<Real> error(x.size()), image(x.size());
    testing::Random random(7);
    for (std::size_t i = 0; i < error.size(); ++i)
    {
      const bool isUsed = i % stride < static_cast<std::size_t>(window.columns());
      error[i] = isUsed ? static_cast<Real>(random.uniform(-1.0, 1.0)) : Real{};
    }
    this->clearFreeBodies(window, stride, error);
    double energy = 0.0, factor = 0.0;
    for (int k = 0; k <= iterations; ++k)
    {
      // The residual of the error, whose product with it is minus the energy.
      std::ranges::copy(error, x.begin());
      std::ranges::fill(b, Real{});
      level.residualAll(image.data());
      double now = 0.0;
      for (std::size_t i = 0; i < error.size(); ++i)
      {
        now -= static_cast<double>(error[i]) * static_cast<double>(image[i]);
      }
      now = std::sqrt(std::max(now, 0.0));
      factor = k > 0 && energy > 0.0 ? now / energy : 0.0;
      if (k == iterations || now == 0.0)
      {
        break;
      }
      std::ranges::copy(image, b.begin());
      this->cycle(level, l, isTwoGrid);
      for (std::size_t i = 0; i < error.size(); ++i)
      {
        error[i] = static_cast<Real>((error[i] + x[i]) / now); // energy 1 before the V-cycle
      }
      energy = 1.0;
    }
    double scaled = 0.0;
    for (std::size_t i = 0; i < error.size(); ++i)
    {
      const auto node = static_cast<std::int64_t>(i / stride);
      window.visitRow(node, [&](const auto&, const auto& arrays, std::int64_t k)
        { scaled += arrays.diagonal[k] * static_cast<double>(error[i]) * error[i]; });
    }
    this->Quotient = scaled > 0.0 ? factor * factor / scaled : 0.0;
    this->Squares.assign(error.size() / stride, 0.0);
    for (std::size_t i = 0; i < error.size(); ++i)
    {
      this->Squares[i / stride] += static_cast<double>(error[i]) * static_cast<double>(error[i]);
    }
    return factor;
  }

  /** Sets the error to 0 in bodies without a condition: up to a constant, nothing reduces it. */
  template <class Real>
  static void clearFreeBodies(
    const LevelWindow<Real>& window, std::size_t stride, std::vector<Real>& error)
  {
    DisjointSets<std::size_t> bodies(error.size() / stride);
    std::vector<char> isHeld(error.size() / stride, 0);
    const auto visit = [&](auto&& f)
    {
      for (std::size_t i = 0; i < isHeld.size(); ++i)
      {
        window.visitRow(static_cast<std::int64_t>(i),
          [&](const auto& h, const auto& a, std::int64_t k) { f(i, h, a, k); });
      }
    };
    visit(
      [&](std::size_t i, const RowBlock::Header& h, const auto& a, std::int64_t k)
      {
        const BlockRange row = entriesOf(h, a, k);
        for (std::int64_t e = row.begin; e < row.end; ++e)
        {
          bodies.join(i, static_cast<std::size_t>(static_cast<std::int64_t>(i) + a.delta[e]));
        }
      });
    visit([&](std::size_t i, const RowBlock::Header& h, const auto& a, std::int64_t k)
      { isHeld[bodies.first(i)] |= RowBlock::rowSumOf(h, a, k) != 0.0 ? 1 : 0; });
    for (std::size_t i = 0; i < error.size(); ++i)
    {
      error[i] = isHeld[bodies.first(i / stride)] ? error[i] : Real{};
    }
  }

  /** A V-cycle from level l, or one of two grids. */
  template <class Real>
  void cycle(Level<Real>& level, int l, bool isTwoGrid)
  {
    Level<float>& coarse = this->Levels.coarse(l + 1);
    level.setScale(1);
    level.setScale(1); // the scale of the last restriction, too
    level.relaxDown();
    coarse.window().zeroB(0, coarse.window().nodes());
    level.restrictAll();
    if (isTwoGrid && l + 2 < this->Levels.count())
    {
      CoreIteration exact(coarse, Exact);
      exact([this] { this->Below.run(); });
    }
    else
    {
      this->Below.run();
    }
    level.prolongAll();
    level.relaxUp();
  }

  LevelsInCore& Levels;
  double Quotient = 0.0;
  CoreVCycle Below; ///< the V-cycle of the levels below
  std::vector<double> Squares;
};

} // namespace smg::benchmark
