// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/ScratchAccount.h"
#include "Solver/Jobs/Fairing/MeshFairing.h"
#include "Solver/Jobs/Fairing/MeshMeasures.h"
#include "Solver/Memory/Pool.h"
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

/** Adds the report of a step to that of all steps: work is summed up, peaks are maxima, and what
 * describes the mesh is that of the step. `name` is that of the step, for Report::steps. */
void addStep(Report& total, const Report& step, const std::string& name);

} // namespace smg

// The steps of MeshFairing.

namespace smg
{

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
  // Of the first step and of columns, the masses are those of the mesh.
  const VertexFile* surface = k > 0 && this->movesPoints() ? &this->Result->values : nullptr;
  const std::string name = "step " + std::to_string(k + 1);
  if (this->Options.keepEdges)
  {
    this->findEdges(k, part.of(0.0, 0.5));
    constexpr double Degree = std::numbers::pi / 180.0;
    // The length over which presmoothing has spread the turn of an edge.
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
  if (this->movesPoints())
  {
    this->keepVolume(part.of(0.9, 1.0));
  }
  else
  {
    std::swap(this->Result->values, this->Next);
  }
}

/** Presmooths the surface by one step of the whole size, which shows its edges without noise. */
void MeshFairing::findEdges(int k, Part part)
{
  const double root = this->Size / (2.0 * std::numbers::pi);
  FairingProblem problem = this->problem(root * root, k > 0 ? &this->Result->values : nullptr);
  this->solveStep(
    problem, "presmoothing " + std::to_string(k + 1), part.of(0.0, 0.9), *this->Presmoothed);
  this->findNormals(*this->Presmoothed, true, part.of(0.9, 1.0));
}

FairingProblem MeshFairing::problem(double t, const VertexFile* surface)
{
  FairingProblem problem(this->Result->memory, t, this->Result->values, this->Held,
    this->hasCurves() ? &*this->Curves : nullptr);
  if (surface)
  {
    problem.setSurface(*surface);
  }
  return problem;
}

void MeshFairing::solveStep(
  FairingProblem& problem, const std::string& name, Part part, VertexFile& to)
{
  SolveOptions options = this->Options;
  const std::int64_t own = this->Result->memory.used(); // none of it by the problem, so far
  options.memoryLimit = std::max<std::int64_t>(this->Options.memoryLimit - own, 1);
  if (this->Options.progress)
  {
    options.progress = [this, part](double done) { return this->Options.progress(part.at(done)); };
  }
  const auto source = this->Mesh.source(this->Columns.vertexColumns(), this->Columns.cellColumns());
  std::unique_ptr<Solution> solution;
  try
  {
    solution = solve(*source, problem, options);
  }
  catch (const MemoryLimitError& error)
  {
    throw error.inside(own, this->Options.memoryLimit);
  }
  to.restart();
  for (std::int64_t first = 0; first < solution->vertices(); first += ChunkVertices)
  {
    const std::int64_t count = std::min(ChunkVertices, solution->vertices() - first);
    this->Values.resize(static_cast<std::size_t>(count * solution->columns()));
    solution->read(first, count, this->Values);
    to.append(this->Values);
  }
  Report report = solution->report();
  report.pool_bytes_peak += own;
  addStep(this->Result->total, report, name);
}

/** The normals at the vertices of a surface; those of held vertices are 0 unless `ofHeld`. */
void MeshFairing::findNormals(const VertexFile& positions, bool ofHeld, Part part)
{
  this->Normals->restart();
  PointNormals normals(this->Result->memory, positions, *this->Normals);
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

/** Makes the result of the last step the current positions, moved along their normals by the
 * distance that keeps the volume. */
void MeshFairing::keepVolume(Part part)
{
  if (this->Options.keepVolume)
  {
    this->findNormals(this->Next, false, part.of(0.0, 0.5));
  }
  double distance = 0.0;
  this->Result->total.volume->swept += this->sweptVolume(part.of(0.5, 1.0), distance);
  if (distance == 0.0)
  {
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
      // A held vertex stays, to the bit.
      this->Values[k] += normals[k] != 0.0 ? distance * normals[k] : 0.0;
    }
    moved.append(this->Values);
  }
}

/** The volume swept from the current positions to those of the last step, moved by `distance` along
 * their normals, which is set so that the volume is 0 if it is to be kept. */
double MeshFairing::sweptVolume(Part part, double& distance)
{
  SweptVolume volume;
  OpenTuples before(this->Result->memory, this->Result->values);
  OpenTuples after(this->Result->memory, this->Next);
  std::optional<OpenTuples> normals;
  if (this->Options.keepVolume)
  {
    normals.emplace(this->Result->memory, *this->Normals);
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
      forCells(CellType::Triangle, block,
        [&](const std::int64_t* corners)
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
    const std::optional<double> root = volume.root(this->Size);
    distance = root.value_or(0.0);
    const char* note = "the volume could not be kept: no motion along the normals makes up for it";
    if (!root &&
        std::ranges::find(this->Result->total.notes, note) == this->Result->total.notes.end())
    {
      this->Result->total.notes.emplace_back(note);
    }
  }
  return volume.at(distance);
}

std::unique_ptr<Solution> MeshFairing::finish()
{
  Report& report = this->Result->total;
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
  const IoStatistics& traffic = this->Result->traffic;
  report.bytes_by_kind.push_back({ "smoothed", -1, traffic.bytesRead, traffic.bytesWritten });
  report.bytes_read += traffic.bytesRead;
  report.bytes_written += traffic.bytesWritten;
  report.pool_bytes_peak = std::max(report.pool_bytes_peak, this->Result->memory.peak());
  report.rss_bytes_peak = peakResidentBytes();
  report.scratch_bytes_peak = this->Result->scratch ? this->Result->scratch->account().peak() : 0;
  report.seconds.total = this->Wall.seconds();
  report.cpu_seconds = processSeconds() - this->CpuAtStart;
  return std::move(this->Result);
}

namespace
{

void addTraffic(std::vector<Report::Traffic>& total, const Report::Traffic& more)
{
  const auto same = std::ranges::find_if(total,
    [&more](const Report::Traffic& t) { return t.kind == more.kind && t.level == more.level; });
  if (same == total.end())
  {
    total.push_back(more);
    return;
  }
  same->read += more.read;
  same->written += more.written;
}

/** Adds those that are not there yet. */
void addNotes(std::vector<std::string>& notes, const std::vector<std::string>& more)
{
  for (const std::string& note : more)
  {
    if (std::ranges::find(notes, note) == notes.end())
    {
      notes.push_back(note);
    }
  }
}

} // namespace

void addStep(Report& total, const Report& step, const std::string& name)
{
  total.converged = (total.steps.empty() || total.converged) && step.converged;
  total.steps.push_back({ name, step.cycles, step.residual(), step.converged });
  total.vertices = step.vertices;
  total.cells = step.cells;
  total.levels = step.levels;
  total.passes += step.passes;
  total.cycles += step.cycles;
  total.residuals.insert(total.residuals.end(), step.residuals.begin(), step.residuals.end());
  total.by_pass.insert(total.by_pass.end(), step.by_pass.begin(), step.by_pass.end());
  total.acceleration = step.acceleration;
  total.peak_nodes = std::max(total.peak_nodes, step.peak_nodes);
  total.pool_bytes_peak = std::max(total.pool_bytes_peak, step.pool_bytes_peak);
  total.rss_bytes_peak = std::max(total.rss_bytes_peak, step.rss_bytes_peak);
  total.bytes_read += step.bytes_read;
  total.bytes_written += step.bytes_written;
  for (const Report::Traffic& traffic : step.bytes_by_kind)
  {
    addTraffic(total.bytes_by_kind, traffic);
  }
  total.seconds.build += step.seconds.build;
  total.seconds.solve += step.seconds.solve;
  total.seconds.coarse += step.seconds.coarse;
  total.seconds.io_wait += step.seconds.io_wait;
  total.seconds.build_io_wait += step.seconds.build_io_wait;
  total.threads = step.threads;
  total.prescribed = step.prescribed;
  total.held = step.held;
  total.degenerate_cells = step.degenerate_cells;
  total.coincident_cells = step.coincident_cells;
  total.clamped_weights = step.clamped_weights;
  total.components = step.components;
  total.free_components = step.free_components;
  addNotes(total.notes, step.notes);
  addNotes(total.warnings, step.warnings);
}

} // namespace smg
