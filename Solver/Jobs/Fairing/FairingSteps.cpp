// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/ReportFields.h"
#include "Solver/Jobs/Fairing/FairingSeries.h"
#include "Solver/Jobs/Fairing/MeshFairing.h"
#include "Solver/Jobs/Fairing/MeshMeasures.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Mesh/VisitCells.h"
#include "Solver/Problem/MeshColumns.h"
#include "smg/Report.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

// The steps of MeshFairing. In each, the boundary curves move first and become prescribed values of
// the surface; then the surface is solved for; then it moves along its normals so that its volume
// is kept. With edges to be kept, the surface is presmoothed first, to see its edges without noise,
// and the step solves with a conductivity that is small across them.
//
// Values are read from one vertex file and written to another one, which is then exchanged with the
// first: Result->values has the current values, Next those after the solve. All sums run in the
// order of the stream, so that blocks and threads do not change a bit.

namespace
{

/** Vertices that are copied at a time. */
constexpr std::int64_t ChunkVertices = 4096;

} // namespace

void MeshFairing::step(int k, Part part)
{
  if (this->hasCurves())
  {
    this->Curves->step(this->Time);
  }
  // In the first step the masses are those of the mesh as it is given. Later steps take them from
  // the current surface (Kazhdan, Solomon and Ben-Chen 2012).
  const VertexFile* surface = k > 0 ? &this->Result->values : nullptr;
  const std::string name = "step " + std::to_string(k + 1);
  if (this->Options.keepEdges)
  {
    this->findEdges(k, part.of(0.0, 0.5));
    constexpr double Degree = std::numbers::pi / 180.0;
    // Presmoothing spreads the turn of a sharp edge over about S / pi: its response to a jump
    // decays over sqrt(t) = S / (2 pi) on either side.
    const EdgeConductivity conductivity(
      this->Size / std::numbers::pi, *this->Options.keepEdges * Degree);
    FairingProblem problem = this->problem(this->Time, &*this->Presmoothed);
    problem.setEdges(*this->Normals, conductivity);
    this->solveStep(problem, name, part.of(0.5, 0.9), this->Next);
  }
  else
  {
    FairingProblem problem = this->problem(this->Time, surface);
    this->solveStep(problem, name, part.of(0.0, 0.8), this->Next);
  }
  this->keepVolume(part.of(0.9, 1.0));
}

/** All steps of a column, whose matrix stays the same. */
void MeshFairing::smoothColumn(Part part)
{
  FairingProblem first = this->problem(this->Time, nullptr);
  const std::int64_t own = this->Job.pool.used();
  const auto source =
    this->surface().source(this->Columns.vertexColumns(), this->Columns.cellColumns());
  const std::unique_ptr<Solution> solution = this->Job.solveBeside(own, part,
    [&](const SolveOptions& solving)
    {
      return FairingSeries(source->info().cellType, first.columns(), this->Options.steps, solving)
        .run(*source, first);
    });
  this->take(*solution, solution->report().steps, own, this->Next);
  std::swap(this->Result->values, this->Next);
}

/** Presmooths the surface by one step of the whole size, whatever the number of steps, and finds
 * the normals of the result. */
void MeshFairing::findEdges(int k, Part part)
{
  const double root = this->Size / (2.0 * std::numbers::pi);
  FairingProblem problem = this->problem(root * root, k > 0 ? &this->Result->values : nullptr);
  this->solveStep(
    problem, "presmoothing " + std::to_string(k + 1), part.of(0.0, 0.9), *this->Presmoothed);
  // The normals of held vertices are needed, too: the surface turns there like anywhere.
  this->findNormals(*this->Presmoothed, true, part.of(0.9, 1.0));
}

/** The problem of a step of the time t. Masses are taken from `surface`, or, if that is null, from
 * the mesh as it is given. */
FairingProblem MeshFairing::problem(double t, const VertexFile* surface)
{
  FairingProblem problem(this->Job.pool, t, this->Result->values, this->Held,
    this->hasCurves() ? &*this->Curves : nullptr);
  if (surface)
  {
    problem.setSurface(*surface);
  }
  return problem;
}

/** Solves one step and stores its result in `to`. */
void MeshFairing::solveStep(
  FairingProblem& problem, const std::string& name, Part part, VertexFile& to)
{
  // In use beside the solve, which has its own pool. The problem has none of it so far, and reports
  // its own (Problem::bytes()).
  const std::int64_t own = this->Job.pool.used();
  const auto source =
    this->surface().source(this->Columns.vertexColumns(), this->Columns.cellColumns());
  const std::unique_ptr<Solution> solution = this->Job.solve(*source, problem, part, own);
  const Report& r = solution->report();
  this->take(*solution, { { name, r.cycles, r.residual(), r.converged } }, own, to);
}

/** Stores the solution of these steps in `to`, and adds its report; `own`: bytes in use beside it.
 */
void MeshFairing::take(
  Solution& solution, const std::vector<Report::Step>& steps, std::int64_t own, VertexFile& to)
{
  // The solution goes to the file of the next values before its scratch files are removed with it.
  to.restart();
  for (std::int64_t first = 0; first < solution.vertices(); first += ChunkVertices)
  {
    const std::int64_t count = std::min(ChunkVertices, solution.vertices() - first);
    this->Values.resize(static_cast<std::size_t>(count * solution.columns()));
    solution.read(first, count, this->Values);
    to.append(this->Values);
  }
  Report report = solution.report();
  report.pool_bytes_peak += own;
  Report& total = this->Job.report;
  total.converged = total.converged || total.steps.empty();
  total.steps.insert(total.steps.end(), steps.begin(), steps.end());
  addFields(total, report);
}

/** Finds the normals at the vertices of the surface with these positions. Those of held vertices
 * are 0, so that they do not move, unless `ofHeld`. */
void MeshFairing::findNormals(const VertexFile& positions, bool ofHeld, Part part)
{
  this->Normals->restart();
  PointNormals normals(this->Job.pool, positions, *this->Normals);
  std::vector<std::uint8_t> held;
  this->read(part,
    [&](const MeshBlock& block)
    {
      held.assign(static_cast<std::size_t>(block.vertices()), 0);
      if (!ofHeld)
      {
        std::ranges::copy(this->Held.at(block), held.begin());
      }
      if (!ofHeld && this->hasCurves())
      {
        this->Curves->forVertices(block.firstVertex, block.vertices(),
          [&held](std::size_t i, const std::array<double, 3>& /*position*/) { held[i] = 1; });
      }
      normals.add(block, held);
    });
  normals.finish();
}

/** Makes the result of the last step the current positions, moved along the normals by the distance
 * with which the surface sweeps no volume in this step. */
void MeshFairing::keepVolume(Part part)
{
  if (this->Options.keepVolume)
  {
    this->findNormals(this->Next, false, part.of(0.0, 0.5));
  }
  double distance = 0.0;
  this->Job.report.volume->swept += this->sweptVolume(part.of(0.5, 1.0), distance);
  if (distance == 0.0)
  {
    // Nothing to add: the files are exchanged.
    std::swap(this->Result->values, this->Next);
    return;
  }
  VertexFile& moved = this->Result->values;
  moved.restart();
  std::vector<double> normals;
  for (std::int64_t first = 0; first < this->Next.vertices(); first += ChunkVertices)
  {
    const std::int64_t count = std::min(ChunkVertices, this->Next.vertices() - first);
    this->Values.resize(static_cast<std::size_t>(3 * count));
    normals.resize(this->Values.size());
    this->Next.read(first, count, this->Values.data());
    this->Normals->read(first, count, normals.data());
    for (std::size_t k = 0; k < normals.size(); ++k)
    {
      // A normal of 0 marks a vertex that stays.
      this->Values[k] += normals[k] != 0.0 ? distance * normals[k] : 0.0;
    }
    moved.append(this->Values);
  }
}

/** Returns the volume that the surface sweeps from the current positions to those of the last step,
 * moved by `distance` along their normals. If the volume is to be kept, sets `distance` such that
 * the swept volume is 0. One reading of the mesh gives the polynomial of which it is a root. */
double MeshFairing::sweptVolume(Part part, double& distance)
{
  SweptVolume volume;
  OpenTuples before(this->Job.pool, this->Result->values);
  OpenTuples after(this->Job.pool, this->Next);
  std::optional<OpenTuples> normals;
  if (this->Options.keepVolume)
  {
    normals.emplace(this->Job.pool, *this->Normals);
  }
  this->read(part,
    [&](const MeshBlock& block)
    {
      before.startBlock(block);
      after.startBlock(block);
      if (normals)
      {
        normals->startBlock(block);
      }
      forUnflaggedCells(CellType::Triangle, block,
        [&](const std::int64_t* corners, std::size_t /*c*/)
        {
          constexpr double None[3] = {};
          const double* x[3];
          const double* y[3];
          const double* n[3];
          for (int c = 0; c < 3; ++c)
          {
            x[c] = before.at(corners[c]);
            y[c] = after.at(corners[c]);
            n[c] = normals ? normals->at(corners[c]) : None;
          }
          volume.add(x, y, n);
        });
    });
  if (this->Options.keepVolume)
  {
    // A motion by more than the size would destroy what the step has kept.
    const std::optional<double> root = volume.root(this->Size);
    distance = root.value_or(0.0);
    const char* note = "the volume could not be kept: no motion along the normals makes up for it";
    if (!root && std::ranges::find(this->Job.report.notes, note) == this->Job.report.notes.end())
    {
      this->Job.report.notes.emplace_back(note);
    }
  }
  return volume.at(distance);
}

/** Completes the report. The vertex files count as traffic of their own kind. */
std::unique_ptr<Solution> MeshFairing::finish()
{
  Report& report = this->Job.report;
  // NaN before, if the surface has a boundary, stays NaN.
  if (report.volume)
  {
    report.volume->after = report.volume->before + report.volume->swept;
  }
  if (this->Result->vertices() == 0)
  {
    report.converged = true;
  }
  if (!this->movesPoints())
  {
    const std::vector<ColumnSpec>& specs = this->Mesh.info().vertexColumns;
    countClipped(*this->Result,
      { *std::ranges::find(specs, this->Options.column, &ColumnSpec::name) }, report);
  }
  this->Job.finishReport();
  return std::move(this->Result);
}

} // namespace smg
