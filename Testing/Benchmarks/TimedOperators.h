// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Timer.h"
#include "Solver/Multigrid/OperatorSet.h"

#include <array>
#include <cstddef>
#include <utility>

namespace smg::benchmark
{

/** The stages from the rows of a level to those of the next one, in order. */
enum class Stage
{
  Choose,
  InterpolateInitial,
  RelaxInterpolation,
  Interpolate,
  Multiply,
  Gather,
  Pack,
  None
};
inline constexpr std::array<const char*, static_cast<std::size_t>(Stage::None)> StageNames = {
  "choose", "initial", "relax", "interpolate", "productAP", "productPtAP", "pack"
};

/**
 * Processor seconds by stage. A stage lasts until another one begins. The clock is read at changes
 * only, which are few, since a stage treats a whole block of nodes; so the overhead is negligible.
 */
class StageClock
{
public:
  void enter(Stage stage)
  {
    if (stage != this->Current)
    {
      const double now = processSeconds();
      this->Seconds[index(this->Current)] += now - this->Since;
      this->Current = stage;
      this->Since = now;
    }
  }
  void stop() { this->enter(Stage::None); }

  double seconds(Stage stage) const { return this->Seconds[index(stage)]; }
  /** Of all stages. */
  double total() const
  {
    double sum = 0.0;
    for (std::size_t s = 0; s < StageNames.size(); ++s)
    {
      sum += this->Seconds[s];
    }
    return sum;
  }

private:
  static std::size_t index(Stage stage) { return static_cast<std::size_t>(stage); }

  std::array<double, StageNames.size() + 1> Seconds{};
  Stage Current = Stage::None;
  double Since = processSeconds();
};

/** Wraps an operator set and reports its active stage to a clock. */
template <OperatorSet Operators>
class TimedOperators
{
public:
  static constexpr const char* name = Operators::name;
  using Relaxation = typename Operators::Relaxation;

  /** Required of an operator set, like forCells(); not usable without a clock. */
  TimedOperators() = default;
  TimedOperators(Operators operators, StageClock& clock)
    : Set(std::move(operators))
    , Clock(&clock)
  {
  }
  static TimedOperators forCells(CellType type)
  {
    TimedOperators timed;
    timed.Set = Operators::forCells(type);
    return timed;
  }

  bool isCoarse(CoarseningData& data, std::int64_t i)
  {
    this->Clock->enter(Stage::Choose);
    return this->Set.isCoarse(data, i);
  }
  void interpolateInitial(CoarseningData& data, std::int64_t i)
  {
    this->Clock->enter(Stage::InterpolateInitial);
    this->Set.interpolateInitial(data, i);
  }
  int interpolationSweeps() const { return this->Set.interpolationSweeps(); }
  void relaxInterpolation(CoarseningData& data, std::int64_t i)
  {
    this->Clock->enter(Stage::RelaxInterpolation);
    this->Set.relaxInterpolation(data, i);
  }
  void interpolate(CoarseningData& data, std::int64_t i)
  {
    this->Clock->enter(Stage::Interpolate);
    this->Set.interpolate(data, i);
  }
  void productAP(CoarseningData& data, std::int64_t i)
  {
    this->Clock->enter(Stage::Multiply);
    this->Set.productAP(data, i);
  }
  void productPtAP(CoarseningData& data, std::int64_t c)
  {
    this->Clock->enter(Stage::Gather);
    this->Set.productPtAP(data, c);
  }
  /** Alternates with productPtAP() and is counted as part of it. */
  void sparsify(CoarseningData& data, std::int64_t c) { this->Set.sparsify(data, c); }

private:
  Operators Set;
  StageClock* Clock = nullptr;
};

} // namespace smg::benchmark
