// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/Timer.h"
#include "Testing/Benchmarks/Kernels.h"
#include "Testing/Benchmarks/LevelsInCore.h"

#include <memory>
#include <string>

namespace smg::benchmark
{
namespace
{

using ::benchmark::State;

/** One of the kernels of a V-cycle, on all of level l. */
template <class Kernel>
void cycleKernel(State& state, LevelsInCore& levels, int l, Kernel kernel)
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
  const auto levels = std::make_shared<LevelsInCore>(mesh, 1);
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
