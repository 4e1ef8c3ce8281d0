// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/Level.h"

namespace smg
{

template <class Real, class Relaxation>
template <bool LowerOnly>
void Level<Real, Relaxation>::sweep(
  std::int64_t begin, std::int64_t end, typename LevelWindow<Real>::State& state)
{
  const int stride = this->Window.stride();
  this->Window.forRange(begin, end, state,
    [stride](const auto& h, const auto& a, BlockRange nodes, Real* x, Real* b)
    {
      if (stride == 1)
      {
        Relaxation::template sweep<LowerOnly, One>(h, a, nodes, 1, x, b);
      }
      for (int lane = 0; lane + 3 < stride; lane += 4)
      {
        Relaxation::template sweep<LowerOnly, Four>(h, a, nodes, stride, x + lane, b + lane);
      }
    });
}

template <class Real, class Relaxation>
void Level<Real, Relaxation>::prolongTo(std::int64_t begin, std::int64_t end)
{
  const int stride = this->Window.stride();
  this->Window.forRange(begin, end, this->Window.up(),
    [&](const auto& h, const auto& a, BlockRange nodes, Real* x, Real*)
    {
      const float* coarse = this->Coarse->window().x().at(h.parentBase);
      if (stride == 1)
      {
        prolong<One, Lanes<float, 1>>(h, a, nodes, 1, x, coarse, this->Unscale);
      }
      for (int lane = 0; lane + 3 < stride; lane += 4)
      {
        prolong<Four, Lanes<float, 4>>(h, a, nodes, stride, x + lane, coarse + lane, this->Unscale);
      }
    });
}

template <class Real, class Relaxation>
void Level<Real, Relaxation>::restrictTo(std::int64_t end)
{
  const int stride = this->Window.stride();
  this->Window.forRange(this->Core ? 0 : this->At.restricted, end, this->Window.down(),
    [&](const auto& h, const auto& a, BlockRange nodes, Real* x, Real* b)
    {
      float* coarse = this->Coarse->window().b().at(h.parentBase);
      Real* squares = this->Squares.data();
      if (stride == 1)
      {
        restrictResidual<One, Lanes<float, 1>>(h, a, nodes, 1, x, b, coarse, this->Scale, squares,
          ResidualKeeper<One>(this->History, h.first, 0));
      }
      for (int lane = 0; lane + 3 < stride; lane += 4)
      {
        restrictResidual<Four, Lanes<float, 4>>(h, a, nodes, stride, x + lane, b + lane,
          coarse + lane, this->Scale, squares + lane,
          ResidualKeeper<Four>(this->History, h.first, lane));
      }
    });
}

} // namespace smg
