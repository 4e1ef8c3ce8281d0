// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/Assembly.h"
#include "Solver/Core/Timer.h"
#include "Solver/Multigrid/Cycle/RowBlockPacker.h"
#include "Solver/Multigrid/Engine/Coarsening.h"
#include "Solver/Multigrid/Extended.h"
#include "Testing/Benchmarks/FixedEndsProblem.h"
#include "Testing/Benchmarks/Kernels.h"
#include "Testing/Benchmarks/TimedOperators.h"
#include "Testing/Support/MemorySource.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace smg::benchmark
{
namespace
{

using ::benchmark::State;

constexpr std::int64_t NoLimit = std::int64_t(1) << 40;

/** The rows of a level, in core. */
struct KeptRows
{
  Pool pool{ NoLimit };
  LevelRows rows{ pool };

  /** Appends rows [begin, end) to `to`. */
  void copy(std::int64_t begin, std::int64_t end, LevelRows& to) const
  {
    for (std::int64_t i = begin; i < end; ++i)
    {
      const auto row = this->rows.row(i);
      const auto size = static_cast<std::int64_t>(row.size());
      std::copy(row.begin(), row.end(), to.open(size));
      to.close(size, this->rows.rowSum(i), this->rows.childReach(i), this->rows.stiff(i),
        this->rows.precise(i));
    }
  }
};

/** Assembles the mesh to `rows`; calls `settle` after each block. */
template <class Settle>
void assemble(const testing::StreamMesh& mesh, LevelRows& rows, Pool& pool, Settle&& settle)
{
  testing::MemorySource source(mesh, 5000);
  FixedEndsProblem problem(source.info());
  ResidentNodes resident;
  LevelWindow<double> window(pool, resident, 0, problem.columns());
  Components components(problem.columns(), &pool);
  ComponentLabels labels(components);
  AssembledRows batch(pool, problem.columns());
  Assembly assembly(pool, source.info(), problem, batch, components, labels);
  const auto step = [&](auto&& make)
  {
    settle(window,
      [&]
      {
        make();
        batch.moveTo(rows, window, problem.columns());
      });
  };
  for (MeshBlock block; source.next(block);)
  {
    step([&] { assembly.add(block); });
  }
  step([&] { assembly.finish(); });
}

void assembling(State& state, const testing::StreamMesh& mesh)
{
  double seconds = 0.0;
  Report::Level level;
  for (auto _ : state)
  {
    const double before = seconds;
    Pool pool(NoLimit);
    LevelRows rows(pool);
    assemble(mesh, rows, pool,
      [&](LevelWindow<double>& window, auto&& add)
      {
        const double start = processSeconds();
        add();
        seconds += processSeconds() - start;
        rows.release(rows.end(), rows.end());
        window.x().release(rows.end());
        window.b().release(rows.end());
      });
    state.SetIterationTime(seconds - before);
    level = { rows.end(), rows.nonzeros() };
  }
  setCounters(state, level, seconds);
}

using TimedStep = Coarsening<TimedOperators<Extended>>;

/** Packs the final blocks from node `begin` on; returns the end of the last one. */
std::int64_t pack(Pool& pool, TimedStep& step, const LevelRows& rows, std::int64_t begin)
{
  const std::int64_t final = step.multiplied();
  const bool ended = rows.Ended && final == rows.end();
  SpareBuffers buffers(pool);
  while (begin + RowBlock::Nodes <= final || (ended && begin < final))
  {
    const std::int64_t nodes = std::min(RowBlock::Nodes, final - begin);
    RowBlock block = packRows(buffers, rows, &step.data(), begin, nodes, false);
    ::benchmark::DoNotOptimize(block.stored().data());
    buffers.give(block.takeBuffer());
    begin += nodes;
    step.packed(begin);
    step.release();
  }
  return begin;
}

void coarsening(State& state, const KeptRows& kept, CellType type)
{
  const Report::Level level{ kept.rows.end(), kept.rows.nonzeros() };
  StageClock clock;
  for (auto _ : state)
  {
    const double before = clock.total();
    Pool pool(NoLimit);
    LevelRows fine(pool), coarse(pool);
    TimedStep step(pool, { Extended::forCells(type), clock }, fine, coarse);
    std::int64_t packed = 0;
    for (std::int64_t end = 0; end < level.nodes;)
    {
      const std::int64_t begin = end;
      end = std::min(level.nodes, begin + RowBlock::Nodes);
      kept.copy(begin, end, fine);
      fine.Ended = end == level.nodes;
      clock.enter(Stage::Choose);
      step.advance();
      step.handOver();
      clock.enter(Stage::Pack);
      packed = pack(pool, step, fine, packed);
      clock.stop();
      coarse.release(coarse.end(), coarse.end());
    }
    state.SetIterationTime(clock.total() - before);
  }
  setCounters(state, level, clock.total());
  for (std::size_t s = 0; s < StageNames.size(); ++s)
  {
    state.counters[StageNames[s]] = perNode(clock.seconds(static_cast<Stage>(s)), state, level);
  }
}

/** The rows of the measured levels. */
std::vector<std::shared_ptr<KeptRows>> keptRows(const testing::StreamMesh& mesh)
{
  std::vector<std::shared_ptr<KeptRows>> levels;
  levels.push_back(std::make_shared<KeptRows>());
  Pool pool(NoLimit);
  assemble(mesh, levels[0]->rows, pool, [](auto&, auto&& add) { add(); });
  for (;;)
  {
    LevelRows fine(pool);
    levels.back()->copy(0, levels.back()->rows.end(), fine);
    fine.Ended = true;
    auto next = std::make_shared<KeptRows>();
    Coarsening<Extended> step(pool, Extended::forCells(mesh.cellType), fine, next->rows);
    step.advance();
    step.handOver();
    if (next->rows.end() < FewestNodes)
    {
      return levels;
    }
    levels.push_back(std::move(next));
  }
}

} // namespace

void addBuildKernels(const testing::StreamMesh& mesh)
{
  ::benchmark::RegisterBenchmark("assemble", [&](State& state) { assembling(state, mesh); })
    ->Unit(::benchmark::kMillisecond)
    ->UseManualTime();
  int l = 0;
  for (const std::shared_ptr<KeptRows>& rows : keptRows(mesh))
  {
    ::benchmark::RegisterBenchmark(("coarsen/level_" + std::to_string(l++)).c_str(),
      [&mesh, rows](State& state) { coarsening(state, *rows, mesh.cellType); })
      ->Unit(::benchmark::kMillisecond)
      ->UseManualTime();
  }
}

} // namespace smg::benchmark
