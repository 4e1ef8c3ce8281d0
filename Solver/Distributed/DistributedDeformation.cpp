// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/DistributedDeformation.h"

#include "Solver/Distributed/CheckPart.h"
#include "Solver/Distributed/DistributedRun.h"
#include "Solver/Jobs/Deformation/DeformationReport.h"
#include "Solver/Jobs/Deformation/RotationProblem.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

// A deformation by several processes: the rotations (four right-hand sides), then the displacements
// (three), with one matrix and one set-up of the preconditioner, since both problems prescribe the
// same vertices and have the same weights. The streaming engine has the same equations
// (Jobs/Deformation); docs/cluster.md has the right-hand side of the displacements.

namespace smg
{
namespace
{

/** The share of the rotations in the progress: four of the seven right-hand sides. */
constexpr double Share = 4.0 / 7.0;

/** The handles of a part. Errors name vertices by their numbers in the mesh, not in the part. */
class PartHandles final : public Handles
{
public:
  PartHandles(Handles& handles, const MeshPart& part)
    : Given(handles)
    , Part(part)
  {
  }

  void at(const MeshBlock& block, VertexHandles& handles) override
  {
    this->Given.at(block, handles);
    // Checked here, since a problem that asked for the handles would see only numbers of the part.
    checkSize(handles, block.vertices());
    for (std::size_t k = 0; k < handles.mask.size(); ++k)
    {
      if (handles.mask[k] > 0)
      {
        checkHeld(handles, k, this->Part.ids[k]);
      }
    }
  }

  std::int64_t bytes() const override { return this->Given.bytes(); }

private:
  Handles& Given;
  const MeshPart& Part;
};

/** The number of vertices of the mesh that several handles hold: each process counts its own
 * vertices, so that shared ones count once. */
std::int64_t countShared(const SharedVertices& vertices, const VertexHandles& handles)
{
  const auto own = std::span(handles.mask)
                     .subspan(static_cast<std::size_t>(vertices.begin()),
                       static_cast<std::size_t>(vertices.end() - vertices.begin()));
  std::int64_t shared = std::ranges::count_if(own, [](std::uint8_t count) { return count > 1; });
  vertices.team().sum({ &shared, 1 });
  return shared;
}

/** Solves a step of the deformation and adds it to the report. */
void solveStep(DistributedRun& run, const char* name, double begin, double end)
{
  Report::Step step = run.iterate(std::string(name) + " step: ", begin, end);
  step.name = name;
  run.report.steps.push_back(std::move(step));
}

} // namespace

DistributedSolution deformParts(const SharedVertices& vertices, const MeshPart& part,
  Handles& handles, Weights weights, const DistributedOptions& options)
{
  // The columns of both steps count in the estimate of the memory.
  constexpr int Columns = RotationProblem::Columns + PositionProblem::Columns;
  DistributedRun run(vertices, part, options, Columns);
  PartHandles given(handles, part);
  RotationProblem rotations(given, weights);
  run.assemble(rotations);
  // Only the counts over all processes say whether a handle holds anything.
  checkAnyHeld(run.report);
  checkSharedTargets(vertices, part, rotations.handles());
  run.report.shared = countShared(vertices, rotations.handles());
  solveStep(run, "rotation", 0.0, Share);
  // The rotations at all vertices of the part, also at vertices of other owners: an edge needs both
  // ends.
  PositionProblem positions(rotations, run.values());
  run.assemble(positions);
  // Rotations of very large targets may overflow; the squares of the right-hand sides show it
  // before the solve.
  checkMotions(run.system().counts.termSquares);
  solveStep(run, "position", Share, 1.0);
  DistributedSolution solution;
  solution.columns = PositionProblem::Columns;
  solution.values = run.values();
  positions.addStart(part.block, solution.values);
  addDeformationNotes(run.report);
  run.finish();
  solution.report = run.report;
  return solution;
}

/** A rotation vector and a logarithm of the scale become the matrix s R - I of each vertex once,
 * not once for each of its edges. */
PositionProblem::PositionProblem(const RotationProblem& rotations, std::span<const double> turns)
  : Rotations(rotations)
{
  this->Frames.reserve(turns.size() / RotationProblem::Columns);
  for (std::size_t k = 0; k < turns.size(); k += RotationProblem::Columns)
  {
    this->Frames.push_back(frameOf(turns.data() + k));
  }
}

void PositionProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  const VertexHandles& handles = this->Rotations.handles();
  for (std::size_t k = 0; k < handles.mask.size(); ++k)
  {
    if (handles.mask[k] > 0)
    {
      conditions.dirichlet[k] = 0;
      for (std::size_t c = 3 * k; c < 3 * k + 3; ++c)
      {
        // The unknown is the displacement u = x - p: near zero where nothing moves, so that
        // rounding and tolerance refer to the motion and not to the coordinates.
        conditions.value[c] = handles.target[c] - block.positions[c];
      }
    }
  }
}

void PositionProblem::edgeTargets(EdgeBatch& batch)
{
  for (std::size_t e = 0; e < batch.from.size(); ++e)
  {
    const Frame& from = this->Frames[static_cast<std::size_t>(batch.from[e])];
    const Frame& to = this->Frames[static_cast<std::size_t>(batch.to[e])];
    const double* a = batch.fromPoint.data() + 3 * e;
    const double* b = batch.toPoint.data() + 3 * e;
    const double edge[3] = { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
    for (int c = 0; c < Columns; ++c)
    {
      // The mean of the frames at both ends: antisymmetric in the ends, as edge targets must be.
      batch.target[3 * e + static_cast<std::size_t>(c)] =
        0.5 * (from.change(c, edge) + to.change(c, edge));
    }
  }
}

/** Held vertices get their targets as they were given: start + (target - start) would round. */
void PositionProblem::addStart(const MeshBlock& block, std::span<double> values) const
{
  const VertexHandles& handles = this->Rotations.handles();
  for (std::size_t k = 0; k < handles.mask.size(); ++k)
  {
    for (std::size_t c = 3 * k; c < 3 * k + 3; ++c)
    {
      values[c] = handles.mask[k] > 0 ? handles.target[c] : block.positions[c] + values[c];
    }
  }
}

} // namespace smg
