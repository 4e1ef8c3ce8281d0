// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Blend.h"

#include "Solver/Core/Text.h"
#include "Solver/Jobs/Blending/BlendProblem.h"
#include "Solver/Jobs/Values/VertexSolution.h"
#include "Solver/Mesh/VisitCells.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Engine/MemoryPlan.h"
#include "Solver/Problem/MeshColumns.h"

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

/** The result: the original values, and the correction that is added to them. */
class BlendedValues final : public VertexSolution
{
public:
  BlendedValues(const SolveOptions& options, int columns)
    : VertexSolution(options, columns, "original")
  {
  }

  void read(std::int64_t first, std::int64_t count, std::span<double> to) override
  {
    this->correction->read(first, count, to);
    this->Start.resize(static_cast<std::size_t>(count * this->columns()));
    this->values.read(first, count, this->Start.data());
    for (std::size_t k = 0; k < this->Start.size(); ++k)
    {
      to[k] += this->Start[k];
    }
  }

  std::unique_ptr<Solution> correction;

private:
  std::vector<double> Start;
};

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
void solveFor(BlendProblem& problem, MeshSource& mesh, std::int64_t own, BlendedValues& blended)
{
  problem.keepIn(blended.values);
  blended.correction = blended.job.solve(mesh, problem, { Known, Solved }, own);
  Report& report = blended.job.report;
  const int readings = report.passes;
  report = blended.correction->report();
  report.passes += readings;
  report.pool_bytes_peak = std::max(report.pool_bytes_peak, problem.memory().peak()) + own;
}

/** Finds the steps between patches in the blended values, in one more reading of the mesh. */
SeamSteps stepsIn(BlendedValues& blended, const std::vector<ColumnSpec>& columns,
  const StoredMesh& mesh, PatchLabels& patches)
{
  SeamSteps steps(columns);
  PatchedValues open(patches, blended.columns());
  const auto source = mesh.source(patches.vertexColumns(), {});
  const CellType type = mesh.info().cellType;
  blended.job.read(*source, { Solved, 1.0 },
    [&](const MeshBlock& block)
    {
      blended.read(block.firstVertex, block.vertices(), open.startBlock(block));
      // The same edges as before the blend, of all cells.
      forAllCells(type, block,
        [&](const std::int64_t* corners, unsigned /*flags*/, std::size_t /*c*/) {
          steps.add({ corners, static_cast<std::size_t>(cornersOf(type)) }, open);
        });
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

} // namespace

std::vector<ColumnSpec> blendedColumns(const StreamInfo& mesh, const BlendDescription& description)
{
  return BlendProblem(description, mesh).specs();
}

std::unique_ptr<Solution> blend(
  const StoredMesh& mesh, const BlendDescription& description, const SolveOptions& given)
{
  checkOptions(given);
  refuseAutomaticTolerance(given, "a blend");
  refuseCheckpoint(given, "a blend has");
  BlendProblem problem(description, mesh.info());
  auto blended = std::make_unique<BlendedValues>(given, problem.columns());
  JobRun& job = blended->job;
  // From here on, every part has what the others leave of the memory limit.
  const std::int64_t own =
    ownBytes(mesh.info(), problem.columns(), description.seam, job.options.inCore);
  // What the problem keeps while it is prepared has the same limit as the solve later.
  problem.memory().setLimit(job.memoryBeside(own));
  requireMemory(mesh.info(), problem.columns(), Weights::Cotangent, job.options);
  const auto source = [&] { return mesh.source(problem.vertexColumns(), problem.cellColumns()); };
  job.read(*source(), { 0.0, Prepared },
    [&](const MeshBlock& block) { problem.prepare(block, job.options.scratch); });
  problem.endPreparing();

  std::optional<PatchGradients> gradients;
  if (description.seam == SeamGradient::Average)
  {
    gradients.emplace(blended->storage, problem.memory(), mesh.info().cellType, problem.columns());
    job.read(*source(), { Prepared, Known },
      [&](const MeshBlock& block) { problem.addTo(*gradients, block); });
    // The file is complete: from here on, the problem reads it.
    gradients->finish();
    problem.average(*gradients);
  }
  solveFor(problem, *source(), own, *blended);
  const SeamSteps after = stepsIn(*blended, problem.specs(), mesh, problem.patches());
  addSeams(problem, after, job.report);
  countClipped(*blended, problem.specs(), job.report);
  job.finishReport();
  addNotes(description.patch, after, mesh.info().cells, job.report);
  job.endProgress();
  return blended;
}

} // namespace smg
