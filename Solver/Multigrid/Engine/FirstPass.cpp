// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/FirstPass.h"

#include "Solver/Assembly/VertexTies.h"
#include "Solver/Core/Timer.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Multigrid/Cycle/VCycle.h"
#include "Solver/Multigrid/Engine/AssemblyReport.h"
#include "Solver/Multigrid/Engine/Corrections.h"
#include "Solver/Multigrid/Engine/MemoryPlan.h"
#include "Solver/Multigrid/Schedule/Schedule.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace smg
{

namespace
{

/** What the problem makes of a mesh stream: vertices that are coupled are neighbours. */
StreamInfo coupled(const StreamInfo& info, const Problem& problem)
{
  StreamInfo coupled = info;
  coupled.span =
    info.span < 0 ? info.span : std::max(info.span, reachOf(problem.couplings().get()));
  return coupled;
}

} // namespace

ColumnResiduals FirstPass::run(
  MeshSource& mesh, Problem& problem, RowListener* listener, std::int64_t furtherCoreBytes)
{
  this->Context.memory.estimate(
    coupled(mesh.info(), problem), problem.columns(), problem.weights(), this->Context.options);
  try
  {
    const ColumnResiduals residual = this->perform(mesh, problem, listener, furtherCoreBytes);
    this->Context.memory.endFirstPass(this->Levels.window().x().capacity());
    return residual;
  }
  catch (const MemoryLimitError& error)
  {
    throw this->Context.explained(error);
  }
}

ColumnResiduals FirstPass::perform(
  MeshSource& mesh, Problem& problem, RowListener* listener, std::int64_t furtherCoreBytes)
{
  const Timer building;
  const SolveOptions& options = this->Context.options;
  requireMemory(
    coupled(mesh.info(), problem), problem.columns(), problem.weights(), options, furtherCoreBytes);
  if (this->Context.scratch)
  {
    this->Context.labels.useScratch(*this->Context.scratch, this->Context.traffic.add("labels"));
  }
  this->Levels.open(mesh.info().vertices);
  const ColumnResiduals residual = this->build(mesh, problem, listener);
  project(this->Context, this->Levels);
  this->Context.report.seconds.build = building.seconds();
  this->Context.report.seconds.build_io_wait = this->Context.traffic.waitSeconds();
  return residual;
}

void FirstPass::project(SolveContext& context, Hierarchy& hierarchy)
{
  if (context.free.project(hierarchy.window(), context.report))
  {
    // The coarse levels were given the right-hand side before the projection, of a problem without
    // a solution: their correction is left out.
    hierarchy.finest().skipNextCorrection();
  }
}

namespace
{

/** Asks also while all that is left of a step is done by other threads. */
class AskingWhileAsleep
{
public:
  AskingWhileAsleep(Workers& workers, CancelCheck& check)
    : Team(workers)
  {
    this->Team.whileSleeping([&check] { check.whileSleeping(); });
  }
  ~AskingWhileAsleep() { this->Team.whileSleeping({}); }
  AskingWhileAsleep(const AskingWhileAsleep&) = delete;
  AskingWhileAsleep& operator=(const AskingWhileAsleep&) = delete;

private:
  Workers& Team;
};

} // namespace

ColumnResiduals FirstPass::build(MeshSource& mesh, Problem& problem, RowListener* listener)
{
  const CellType type = mesh.info().cellType;
  // Only among the true finite elements there are weights that cancel.
  const bool placed = this->Operators.readsPositions && problem.weights() == Weights::Cotangent;
  AssembledRows rows(this->Context.pool, problem.columns(), placed);
  const bool pipelined = this->Context.threads.areConcurrent() && this->Context.memory.isAmple();
  CancelCheck check([this] { this->Context.progress.updateFirst(0.0); });
  const AskingWhileAsleep asking(this->Context.threads.workers, check);
  HierarchyBuilder builder(this->Context.pool, this->Operators, this->Levels.storage(),
    this->Levels.firstCore(), Assembly::stiffRows(type, problem.weights(), rows), pipelined, check);
  Assembly assembly(this->Context.pool, mesh.info(), problem, rows, this->Context.components,
    this->Context.labels, listener, this->Context.corrected);
  this->Levels.startPass(true);
  MeshPrefetch blocks(mesh, this->Context.threads.areConcurrent());
  // The stages of the assembly run as tasks of their own only if the next block is read ahead: they
  // need the number of its vertices to reserve room.
  this->readStream(blocks, pipelined && blocks.isAhead(), assembly, rows, builder);
  const int coarsest = builder.finish([this](int l) { this->Levels.addCoreLevel(l); });
  check.end();
  this->Levels.endPass();
  this->Levels.close(coarsest);
  return this->note(assembly);
}

/** Assembles the current block of the mesh, or at its end what is left; returns whether there was a
 * block. `pipelined`: only weighs its cells, of which the other stages make rows. */
bool FirstPass::assembleNext(MeshPrefetch& blocks, bool pipelined, Assembly& assembly)
{
  const MeshBlock* block = blocks.block();
  if (pipelined)
  {
    block ? assembly.weigh(*block) : assembly.weighRest();
  }
  else
  {
    block ? assembly.add(*block) : assembly.finish();
  }
  return block != nullptr;
}

/** In each step the next block of the mesh is assembled, every streamed level is coarsened, and
 * the downward part of the V-cycle advances, all as tasks that may run at the same time, each
 * on the data of earlier steps. With `pipelined`, the stages of the assembly are tasks of their own
 * as well. */
void FirstPass::readStream(MeshPrefetch& blocks, bool pipelined, Assembly& assembly,
  AssembledRows& rows, HierarchyBuilder& builder)
{
  auto& finest = this->Levels.finest();
  bool more = true, waits = false;
  std::int64_t open = 0;
  const auto expected = static_cast<double>(std::max<std::int64_t>(1, blocks.info().vertices));
  if (StepRecorder* recorder = this->Context.threads.recorder)
  {
    recorder->startPass({});
  }
  Schedule schedule(this->Context.trace());
  // Task 0, which asks the problem, runs on the thread of the caller.
  schedule.add(
    { pipelined ? "weigh cells" : "assemble rows", 0, 0.0,
      [&](bool) { more = more && (waits || assembleNext(blocks, pipelined, assembly)); } },
    [&assembly, pipelined]
    { return assembly.vertices() - (pipelined ? 0 : assembly.openVertices()); });
  if (pipelined)
  {
    schedule.startChain();
    schedule.add({ "connect edges", 0, 0.0, [&](bool) { waits ? void() : assembly.connect(); } });
    schedule.startChain();
    schedule.add({ "close rows", 0, 0.0, [&](bool) { waits ? void() : assembly.closeRows(); } },
      [&assembly] { return assembly.vertices() - assembly.openVertices(); });
  }
  builder.addStages(schedule);
  const std::size_t downward = schedule.stages().size();
  schedule.startChain();
  addDownward(finest, schedule);
  schedule.trace().addWindow(
    0, [&finest] { return finest.window().first(); }, [&assembly] { return assembly.vertices(); });
  schedule.addBeside([&blocks] { blocks.read(); });
  finest.addWriters(schedule);
  schedule.perform(
    this->Context.threads,
    [&]
    {
      if (builder.complete())
      {
        return false;
      }
      builder.begin();
      // A block of the mesh may have many more rows than a step: no further block is read while
      // rows wait, since these take memory.
      waits = builder.isBusy();
      if (!waits)
      {
        blocks.advance();
      }
      if (pipelined && !waits)
      {
        assembly.beginPipelined(blocks.vertices());
      }
      finest.publish();
      return true;
    },
    [&]
    {
      finest.release();
      if (pipelined)
      {
        assembly.release();
      }
      // Between two steps: what moves may be memory that tasks read.
      rows.moveTo(builder.finestRows(), finest.window(), finest.window().columns());
      builder.finestRows().Ended = !more && assembly.isClosed();
      builder.handOver();
      // Vertices that wait for cells are in memory like nodes.
      this->Context.resident.add(assembly.openVertices() - open);
      open = assembly.openVertices();
      this->Context.progress.updateFirst(static_cast<double>(assembly.vertices()) / expected);
    });
  schedule.advance(downward);
  finest.settle();
  schedule.trace().endStep();
  this->Context.note(schedule, true);
  if (assembly.vertices() == 0)
  {
    throw Error("the mesh has no vertices");
  }
  this->Context.labels.finish();
}

/** Adds the data of the assembly and of the levels to the report, and what later passes need to
 * the hierarchy. Returns the residual of the initial values. */
ColumnResiduals FirstPass::note(const Assembly& assembly)
{
  // With more stiff rows than this share, the slowest errors may be local to them; see Iteration.
  constexpr std::int64_t StiffShare = 512;
  // Coefficients that differ less do not change what the tolerance means.
  constexpr double Contrasting = 100.0;
  this->Levels.setSlowestAtSlivers(assembly.stiffRows() > assembly.vertices() / StiffShare);
  Report& r = this->Context.report;
  this->Context.components.anchorHeld();
  reportAssembly(assembly, this->Context.components, r);
  r.levels = this->Levels.storage().sizes;
  if (const std::int64_t frozen = this->Levels.storage().frozen; frozen > 0)
  {
    r.notes.push_back(std::to_string(frozen) +
                      " nodes of coarse levels have weights that cancel and get no correction "
                      "there: more V-cycles may be needed");
  }
  // Vertices with given values have an empty row, but are not unknowns.
  r.levels.front().nodes -= r.prescribed + r.held;
  r.levels.front().nonzeros -= r.prescribed + r.held;
  if (this->Context.mayMeasureFlow && assembly.contrast() >= Contrasting)
  {
    this->Levels.measureFlow();
    // Room that is not needed matters less than a correction for which there is none.
    const SolveOptions& options = this->Context.options;
    const double contrast = 10.0 * assembly.contrast();
    if (options.again && correctionTolerance(contrast, options.tolerance) < 1.0)
    {
      this->Context.progress.leaveRoom();
    }
  }
  this->Context.keepReport();
  return residualOf(assembly.residual(), this->Context.components);
}

ColumnResiduals FirstPass::residualOf(const InitialResidual& residual, const Components& components)
{
  // If the sources equal their mean, only the rounding of this difference of squares remains, which
  // does not measure the residual: then the sources themselves do.
  const double minShare = components.anyHeldLoosely() ? 1e-12 : 1e-14;
  const std::span<const double> squares = residual.squares();
  // The mean of the initial values, whose rounding may be more than all that varies, is no longer
  // in the iterates of components that are held loosely.
  const std::span<const double> rounding =
    components.initialMeans().empty() ? residual.roundingSquares() : residual.loadSquares();
  ColumnResiduals columns{ components.shiftedSquares(), { rounding.begin(), rounding.end() },
    residual.varying.norms(components) };
  for (std::size_t k = 0; k < squares.size(); ++k)
  {
    const double shifted = std::max(0.0, squares[k] + columns.squares[k]);
    columns.squares[k] = shifted < minShare * squares[k] ? squares[k] : shifted;
    if (columns.references[k] == 0.0)
    {
      columns.references[k] = std::sqrt(columns.squares[k]);
    }
  }
  return columns;
}

} // namespace smg
