// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/Shi2006/Shi2006.h"

#include "Solver/Core/Timer.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Multigrid/Engine/AssemblyReport.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Testing/Benchmarks/Shi2006/EdgeOperators.h"
#include "Testing/Benchmarks/Shi2006/VCycle.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

// The solver with the equations as the paper prints them, in core. It assembles the finest level
// from the rows that the streaming engine makes (FinestRows), builds all levels (VCycle) and
// performs V-cycles. It exists to compare with the paper: Shi2006.h says why it does not converge
// to the solution. Memory is proportional to the vertices and edges of all levels together.

namespace smg
{
namespace
{

constexpr PoolUse InCoreMemory{ "a solve by shi2006",
  "raise the memory limit, or use smg solve, which works out of core" };

/** The finest level in the interface that FreeComponents expects of a level. */
struct FinestState
{
  shi2006::Level& level;

  std::int64_t nodes() const { return this->level.nodes(); }
  void readX(std::int64_t first, std::int64_t count, double* values) const
  {
    std::copy_n(this->level.value.at(first), count * this->level.columns(), values);
  }
  template <class F>
  void rewriteX(F&& f) const
  {
    this->rewrite(this->level.value, f);
  }
  /** Changes xi0 instead of b, block by block: b also has the contributions of the edge targets,
   * which must not change, and is summed again afterwards. */
  template <class F>
  void rewriteB(F&& f) const
  {
    this->rewrite(this->level.constraint, f);
  }

private:
  template <class Numbers, class F>
  void rewrite(Numbers& numbers, F&& f) const
  {
    constexpr auto Block = static_cast<std::int64_t>(ComponentLabels::Block);
    for (std::int64_t first = 0; first < this->nodes(); first += Block)
    {
      const std::int64_t count = std::min(Block, this->nodes() - first);
      f(first / Block,
        std::span(numbers.at(first), static_cast<std::size_t>(count * this->level.columns())));
    }
  }
};

} // namespace

Shi2006::Shi2006(int columns, const SolveOptions& options)
  : Columns(columns)
  , Options(options)
  , Progress(options.progress)
  , Memory(options.memoryLimit, InCoreMemory)
  , Parts(columns, &this->Memory)
  , Labels(this->Parts)
  , Free(this->Parts, this->Labels, columns)
  , Values(this->Memory, columns)
{
}

void Shi2006::solve(MeshSource& mesh, Problem& problem)
{
  checkOptions(this->Options);
  // The iteration has no error to balance.
  refuseAutomaticTolerance(this->Options, "a solve by shi2006");
  checkProblem(problem);
  const Timer wall;
  const double cpuAtStart = processSeconds();
  Report& r = this->Result;
  // The progress is reported as by the streaming engine: by V-cycles to a tolerance.
  this->Progress.begin({ this->Options.tolerance, this->Options.maxCycles }, 0.0, 1.0, true);
  shi2006::Level finest(this->Memory, this->Columns);
  this->assemble(mesh, problem, finest);
  shi2006::VCycle cycle(this->Memory, finest, this->Options.sweeps);
  this->describe(cycle);
  r.seconds.build = wall.seconds();
  const Timer solving;
  this->iterate(cycle, finest);
  FinestState state{ finest };
  // Components without constraint: their solution is determined up to a constant, which is chosen
  // here.
  this->Free.fix(state, problem, r);
  r.seconds.solve = solving.seconds();
  // The values outlive the levels, for read().
  this->Values = std::move(finest.value);
  addAssemblyNotes(r, this->Free.undetermined());
  r.pool_bytes_peak = this->Memory.peak();
  r.rss_bytes_peak = peakResidentBytes();
  r.seconds.total = wall.seconds();
  r.cpu_seconds = processSeconds() - cpuAtStart;
  this->Progress.finish();
}

/** The memory of the finest level of a closed mesh without constrained vertices. The coarser levels
 * are not counted, so that no solve is rejected that might fit. */
std::int64_t Shi2006::estimateMemory(const StreamInfo& info, int columns)
{
  const auto value = static_cast<std::int64_t>(sizeof(double)) * columns;
  const std::int64_t node = static_cast<std::int64_t>(sizeof(shi2006::Node) + 8) + 3 * value;
  const std::int64_t edge = static_cast<std::int64_t>(sizeof(shi2006::Edge)) + value;
  // By Euler's formula a surface has about twice as many triangles as vertices, hence 3/2 edges per
  // triangle; a tetrahedral mesh has about twice as many triangles as cells, hence as many edges as
  // vertices and cells together.
  const std::int64_t edges =
    info.cellType == CellType::Triangle ? info.cells * 3 / 2 : info.vertices + info.cells;
  // An edge is stored with both of its nodes.
  return info.vertices * node + 2 * edges * edge;
}

void Shi2006::assemble(MeshSource& mesh, Problem& problem, shi2006::Level& finest)
{
  const StreamInfo& info = mesh.info();
  // Refused at once, with the figure for the whole level, rather than somewhere while it grows.
  if (const std::int64_t need = estimateMemory(info, this->Columns); need > this->Memory.limit())
  {
    throw MemoryLimitError(need, this->Memory.limit(), InCoreMemory);
  }
  shi2006::FinestRows rows(this->Memory, info, problem, this->Parts, this->Labels, finest);
  MeshBlock block;
  const auto expected = static_cast<double>(std::max<std::int64_t>(1, info.vertices));
  while (mesh.next(block))
  {
    rows.add(block);
    this->Progress.updateFirst(static_cast<double>(rows.assembly().vertices()) / expected);
  }
  if (rows.assembly().vertices() == 0)
  {
    throw Error("the mesh has no vertices");
  }
  // The order matters: components are complete only with all rows, their sums are needed to make
  // the right-hand side compatible, and that goes into b.
  rows.finish();
  this->Labels.finish();
  this->Parts.settle();
  reportAssembly(rows.assembly(), this->Parts, this->Result);
  this->RoundingNorm = roundingOf(rows.assembly().residual().termSquares());
  FinestState state{ finest };
  this->Free.project(state, this->Result);
  sumRightSide(finest);
  this->Result.passes = 1;
}

void Shi2006::describe(const shi2006::VCycle& cycle)
{
  Report& r = this->Result;
  // All levels are in memory at once, so all their nodes count in the peak.
  for (std::size_t l = 0; l < cycle.levels(); ++l)
  {
    const shi2006::Level& level = cycle.level(l);
    r.levels.push_back({ level.nodes(), level.nonzeros() });
    r.peak_nodes += level.nodes();
  }
  // Constrained vertices are nodes of the finest level without edges, but not unknowns.
  r.levels.front().nodes -= r.prescribed + r.held;
  r.levels.front().nonzeros -= r.prescribed + r.held;
  // More parts without a constraint than the mesh has: lifting has cut them off.
  if (cycle.detachedParts() > r.free_components)
  {
    r.notes.push_back(
      "lifting has torn the mesh into parts that no constraint reaches, which makes "
      "the result much worse: convert the mesh with the order bfs");
  }
}

/** Performs V-cycles until the tolerance is reached or the residual hardly changes. The tolerance
 * is relative to the initial residual or, if that is smaller, to the rounding of its terms. */
void Shi2006::iterate(shi2006::VCycle& cycle, const shi2006::Level& finest)
{
  // The result of a V-cycle does not depend on its initial values, so further ones do not help: a
  // residual above this share of the one before ends the loop.
  constexpr double Final = 0.9;
  // A V-cycle rounds several times as much as the terms of the residual.
  constexpr double NearRounding = 10.0;
  Report& r = this->Result;
  const auto norm = [&] { return std::sqrt(shi2006::residualSquares(finest)); };
  const double first = norm();
  const double reference = std::max(first, this->RoundingNorm);
  const double least = NearRounding * this->RoundingNorm;
  double now = first;
  double before = now;
  const auto done = [&]
  {
    r.converged = now <= std::max(this->Options.tolerance * reference, least);
    return r.converged || r.cycles == this->Options.maxCycles ||
           (r.cycles > 1 && now > Final * before);
  };
  while (!done())
  {
    cycle.run([this](double share) { this->Progress.update(share); });
    before = now;
    now = norm();
    if (!std::isfinite(now))
    {
      throw Error("the values overflow: scale the mesh, the prescribed values or the sources");
    }
    ++r.cycles;
    r.residuals.push_back(now / reference);
    this->Progress.endCycle(r.cycles, r.residuals.back());
  }
  if (!r.converged)
  {
    r.notes.push_back("not converged: the relative residual is " + scientific(r.residual()) +
                      " after " + std::to_string(r.cycles) + " V-cycles; further ones do not help");
  }
  r.notes.push_back("shi2006 are the equations as the paper prints them: unless the edge targets "
                    "are integrable, their result carries a bias that no further V-cycle removes; "
                    "use the operator set extended for solutions");
}

void Shi2006::read(std::int64_t first, std::int64_t count, std::span<double> values)
{
  checkVertexRange(
    first, count, values.size() / static_cast<std::size_t>(this->Columns), this->Result.vertices);
  std::copy_n(this->Values.at(first), count * this->Columns, values.data());
  // Values of free components are completed as they are read.
  this->Free.complete(first, count, values);
}

} // namespace smg

namespace smg::shi2006
{
namespace
{

/** Appends one item of `lanes` values. */
void append(Ring<double>& to, const double* values)
{
  const std::int64_t end = to.end();
  to.extendRaw(end + 1);
  std::copy_n(values, to.lanes(), to.at(end));
}

} // namespace

FinestRows::FinestRows(Pool& pool, const StreamInfo& info, Problem& problem, Components& components,
  ComponentLabels& labels, Level& level)
  : Finest(level)
  , Made(pool, problem.columns())
  , Rows(pool)
  , State(pool, this->Resident, 0, problem.columns())
  , Assembled(pool, info, problem, this->Made, components, labels, this)
{
}

void FinestRows::add(const MeshBlock& block)
{
  this->Assembled.add(block);
  this->take();
}

void FinestRows::finish()
{
  this->Assembled.finish();
  this->take();
}

void FinestRows::target(const double* target)
{
  append(this->Finest.target, target);
}

void FinestRows::constraint(const double* sum)
{
  append(this->Finest.constraint, sum);
}

/** Moves the final rows to the level. */
void FinestRows::take()
{
  Level& level = this->Finest;
  const int columns = level.columns();
  // Rows come in stream order, as soon as their vertices are final: the windows between assembly
  // and level hold only rows that were not taken yet.
  this->Made.moveTo(this->Rows, this->State, columns);
  const std::int64_t begin = level.nodes();
  const std::int64_t end = this->Rows.end();
  level.node.extendRaw(end);
  level.value.extendRaw(end);
  level.rightSide.extendRaw(end);
  for (std::int64_t i = begin; i < end; ++i)
  {
    const auto row = this->Rows.row(i);
    Edge* edge = level.edges.open(static_cast<std::int64_t>(row.size()));
    for (const RowEntry& entry : row)
    {
      // The window stores neighbours by their distance from the row; a level in memory stores their
      // numbers.
      *edge++ = { i + entry.delta(), entry.weight() };
    }
    level.edges.close(static_cast<std::int64_t>(row.size()));
    level.node[i] = { this->Rows.rowSum(i), this->Rows.diagonal(i) };
    std::copy_n(this->State.x().at(i), columns, level.value.at(i));
  }
  level.target.extend(level.edges.start(end)); // without edge targets: zero
  this->Rows.release(end, end);
  this->State.x().release(end);
  this->State.b().release(end);
}

} // namespace smg::shi2006
