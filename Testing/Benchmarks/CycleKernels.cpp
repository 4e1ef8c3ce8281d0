// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/Timer.h"
#include "Solver/Engine/FirstPass.h"
#include "Solver/Engine/Hierarchy.h"
#include "Solver/Engine/SolveRun.h"
#include "Solver/Operators/Extended.h"
#include "Testing/Benchmarks/FixedEndsProblem.h"
#include "Testing/Benchmarks/Kernels.h"
#include "Testing/Support/MemorySource.h"

#include <memory>
#include <string>

namespace smg::benchmark
{
namespace
{

using ::benchmark::State;

/** The levels of a solve in core, between two passes. */
class CoreLevels
{
public:
  explicit CoreLevels(const testing::StreamMesh& mesh)
    : Run(Columns, options())
    , Levels(this->Run, Columns)
  {
    testing::MemorySource source(mesh);
    FixedEndsProblem problem(source.info());
    const Extended operators = Extended::forCells(mesh.cellType);
    FirstPass(this->Run, this->Levels, operators)(source, problem);
    this->Levels.startPass(false);
  }

  int count() { return static_cast<int>(this->Levels.levels().sizes.size()); }
  const Report::Level& size(int l) { return this->Levels.levels().sizes[l]; }

  /** Calls f with level l. */
  template <class F>
  void with(int l, F&& f)
  {
    if (l == 0)
    {
      f(this->Levels.finest());
    }
    else
    {
      f(*this->Levels.levels().coarse[static_cast<std::size_t>(l - 1)]);
    }
  }

private:
  static constexpr int Columns = 3;

  static SolveOptions options()
  {
    SolveOptions options;
    options.inCore = true;
    options.memoryLimit = std::int64_t(1) << 40;
    options.sweeps = 1;
    options.threads = 1;
    return options;
  }

  SolveRun Run;
  Hierarchy<GaussSeidel> Levels;
};

/** One of the kernels of a V-cycle, on all of level l. */
template <class Kernel>
void cycleKernel(State& state, CoreLevels& levels, int l, Kernel kernel)
{
  const double start = processSeconds();
  levels.with(l,
    [&](auto& level)
    {
      for (auto _ : state)
      {
        kernel(level);
        ::benchmark::ClobberMemory();
      }
    });
  setCounters(state, levels.size(l), processSeconds() - start);
}

} // namespace

void addCycleKernels(const testing::StreamMesh& mesh)
{
  const auto levels = std::make_shared<CoreLevels>(mesh);
  const auto add = [&](const char* name, int l, auto kernel)
  {
    ::benchmark::RegisterBenchmark((name + std::string("/level_") + std::to_string(l)).c_str(),
      [=](State& state) { cycleKernel(state, *levels, l, kernel); })
      ->Unit(::benchmark::kMillisecond);
  };
  for (int l = 0; l + 1 < levels->count() && levels->size(l).nodes >= FewestNodes; ++l)
  {
    add("sweep", l, [](auto& level) { level.relaxUp(); });
    add("restrict", l, [](auto& level) { level.restrictAll(); });
    add("prolong", l, [](auto& level) { level.prolongAll(); });
  }
}

} // namespace smg::benchmark
