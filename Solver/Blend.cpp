// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Blend.h"

#include "Solver/Core/Text.h"
#include "Solver/Core/Timer.h"
#include "Solver/Files/ScratchAccount.h"
#include "Solver/Jobs/Blending/BlendProblem.h"
#include "Solver/Jobs/Blending/BlendedValues.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Engine/MemoryEstimate.h"
#include "Solver/Problem/MeshColumns.h"
#include "smg/Error.h"

#include <algorithm>
#include <optional>

// The entry of a blend. The mesh is read for each of these: the patches, the bounds and what is
// held; with averaged seams, the gradients inside the patches; the solve for the correction, in
// which the original values go to a vertex file; and the steps between patches that remain. The
// result adds the correction to the original values as they are read.

namespace smg
{

namespace
{

/** Bytes that a blend needs beside the solver and the problem. In core these are the original
 * values and the gradients; otherwise both are on scratch files. */
std::int64_t ownBytes(const StreamInfo& mesh, std::int64_t columns, SeamGradient seam, bool inCore)
{
  constexpr std::int64_t Number = sizeof(double);
  const std::int64_t gradients = seam == SeamGradient::Average ? 1 + 3 * columns : 0;
  return inCore && mesh.vertices > 0 ? mesh.vertices * (columns + gradients) * Number : 0;
}

/** The progress after the first reading of the mesh, when the gradients are known, and after the
 * solve. */
constexpr double Prepared = 0.08, Known = 0.12, Solved = 0.9;

/** Solves for the correction, within what `own` bytes beside it leave of the memory limit. */
void solveFor(BlendProblem& problem, MeshSource& mesh, std::int64_t own,
  const SolveOptions& options, BlendedValues& blended)
{
  problem.keepIn(blended.originals);
  SolveOptions solving = options;
  solving.memoryLimit = std::max<std::int64_t>(options.memoryLimit - own, 1);
  if (options.progress)
  {
    solving.progress = [&options](double done)
    { return options.progress(Known + done * (Solved - Known)); };
  }
  try
  {
    blended.correction = solve(mesh, problem, solving);
  }
  catch (const MemoryLimitError& error)
  {
    // The message has to state the limit that the user knows.
    throw error.inside(own, options.memoryLimit);
  }
  blended.total = blended.correction->report();
  blended.total.pool_bytes_peak =
    std::max(blended.total.pool_bytes_peak, problem.memory().peak()) + own;
}

/** Finds the steps between patches in the blended values, in one more reading of the mesh. */
SeamSteps stepsIn(Solution& blended, const std::vector<ColumnSpec>& columns, const StoredMesh& mesh,
  PatchLabels& patches, const ProgressFunction& progress)
{
  SeamSteps steps(columns);
  PatchedValues open(patches, blended.columns());
  const auto source = mesh.source(patches.vertexColumns(), {});
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.info().cellType));
  visitBlocks(*source, progress, Solved, 1.0,
    [&](const MeshBlock& block)
    {
      blended.read(block.firstVertex, block.vertices(), open.startBlock(block));
      for (std::size_t c = 0; c < block.corners.size(); c += corners)
      {
        // The same edges as before the blend, of all cells.
        steps.add(std::span(block.corners).subspan(c, corners), open);
      }
    });
  return steps;
}

/** Reports the steps of each column before and after. */
void addSeams(const BlendProblem& problem, const SeamSteps& after, Report& report)
{
  const std::vector<double> stepsBefore = problem.steps().largest(), stepsAfter = after.largest();
  for (std::size_t k = 0; k < problem.specs().size(); ++k)
  {
    report.seams.push_back({ problem.specs()[k].name, stepsBefore[k], stepsAfter[k] });
  }
}

/** Adds notes: that there was nothing to blend, or that the column of patches may be the wrong
 * one. */
void addNotes(const std::string& patch, const SeamSteps& steps, std::int64_t cells, Report& report)
{
  if (steps.edges() == 0)
  {
    report.notes.push_back(
      "No edge connects two patches of the column '" + patch + "': the columns stay as they are.");
  }
  // A column of values instead of numbers of patches makes every cell one between patches.
  if (steps.cells() > cells / 2)
  {
    report.notes.push_back(std::to_string(steps.cells()) + " of " +
                           counted(cells, "cell lies", "cells lie") +
                           " between patches of the column '" + patch +
                           "', where the detail of the columns is lost: is this the column with "
                           "the number of the scan or region of each vertex or cell?");
  }
}

void addOriginalTraffic(const IoStatistics& traffic, Report& report)
{
  report.bytes_read += traffic.bytesRead;
  report.bytes_written += traffic.bytesWritten;
  report.bytes_by_kind.push_back({ "original", -1, traffic.bytesRead, traffic.bytesWritten });
}

} // namespace

std::vector<ColumnSpec> blendedColumns(const StreamInfo& mesh, const BlendDescription& description)
{
  return BlendProblem(description, mesh).specs();
}

std::unique_ptr<Solution> blend(
  const StoredMesh& mesh, const BlendDescription& description, const SolveOptions& given)
{
  const Timer wall;
  const double cpuAtStart = processSeconds();
  checkOptions(given);
  refuseAutomaticTolerance(given, "a blend");
  if (!given.checkpoint.folder.empty())
  {
    throw Error("a blend has no checkpoints: leave the folder out");
  }
  BlendProblem problem(description, mesh.info());
  auto blended = std::make_unique<BlendedValues>(given, problem.columns());
  SolveOptions options = given;
  if (blended->scratch)
  {
    // The folder counts the files of the solve that are made in it, too, for one common limit.
    options.scratch = blended->scratch->path();
  }
  // From here on, every part has what the others leave of the memory limit.
  const std::int64_t own =
    ownBytes(mesh.info(), problem.columns(), description.seam, options.inCore);
  // What the problem keeps while it is prepared has the same limit as the solve later.
  problem.memory().setLimit(std::max<std::int64_t>(options.memoryLimit - own, 1));
  requireMemory(mesh.info(), problem.columns(), Weights::Cotangent, options);
  const auto source = [&] { return mesh.source(problem.vertexColumns(), problem.cellColumns()); };
  visitBlocks(*source(), options.progress, 0.0, Prepared,
    [&](const MeshBlock& block) { problem.prepare(block, options.scratch); });
  problem.endPreparing();

  std::optional<PatchGradients> gradients;
  if (description.seam == SeamGradient::Average)
  {
    gradients.emplace(
      blended->storage(), problem.memory(), mesh.info().cellType, problem.columns());
    visitBlocks(*source(), options.progress, Prepared, Known,
      [&](const MeshBlock& block) { problem.addTo(*gradients, block); });
    // The file is complete: from here on, the problem reads it.
    gradients->finish();
    problem.average(*gradients);
  }
  solveFor(problem, *source(), own, options, *blended);
  const SeamSteps after =
    stepsIn(*blended, problem.specs(), mesh, problem.patches(), options.progress);

  Report& report = blended->total;
  // In addition to the passes of the solve: the patches, the steps that remain and, if they are
  // averaged, the gradients.
  report.passes += description.seam == SeamGradient::Average ? 3 : 2;
  addSeams(problem, after, report);
  countClipped(*blended, problem.specs(), report);
  addOriginalTraffic(blended->traffic, report);
  report.scratch_bytes_peak = blended->scratch ? blended->scratch->account().peak() : 0;
  report.seconds.total = wall.seconds();
  report.cpu_seconds = processSeconds() - cpuAtStart;
  addNotes(description.patch, after, mesh.info().cells, report);
  // The last step may cancel like any other.
  if (options.progress && !options.progress(1.0))
  {
    throw Cancelled();
  }
  return blended;
}

} // namespace smg
