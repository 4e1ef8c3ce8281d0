// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/MeshFairing.h"

#include "Solver/Assembly/Facets.h"
#include "Solver/Core/Text.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Mesh/StreamCheck.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/MemoryPlan.h"
#include "Solver/Problem/MeshColumns.h"
#include "smg/Error.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// Implicit fairing of a surface, or of a column of any mesh (Desbrun, Meyer, Schroeder and Barr
// 1999; smg/Smooth.h has the equations). This file has the survey: one reading that finds what is
// held, the boundary, the current values and the lengths that a size refers to. FairingSteps.cpp
// has the steps, each of which is a solve of a FairingProblem.
//
// A wave of length l is multiplied by 1 / (1 + t (2 pi / l)^2) in a step, so that N steps with t =
// (2^(1/N) - 1) (S / 2 pi)^2 halve waves of length S; a step can be arbitrarily large without
// becoming unstable. All values are in vertex files, on scratch files unless everything is in core,
// so that the memory holds a solve, windows of the stream, and the boundary as a whole.

namespace smg
{

namespace
{

/** The boundary as asked for, or the default, which differs for positions and columns. */
SmoothedBoundary boundaryOf(const Smoothing& options)
{
  return options.boundary.value_or(
    options.column.empty() ? SmoothedBoundary::Smooth : SmoothedBoundary::Free);
}

/** The column to smooth; none: the positions. */
std::optional<NamedColumn> columnOf(
  const std::string& name, CellType cellType, MeshColumns& columns)
{
  if (name.empty())
  {
    // Moving the boundary of a solid alone would invert cells.
    if (cellType != CellType::Triangle)
    {
      throw Error("the positions of tetrahedra cannot be smoothed, only those of triangles: name a "
                  "column of the vertices to smooth instead");
    }
    return std::nullopt;
  }
  if (name == OriginalIdName)
  {
    columns.fail("column", '\'' + name + "' numbers the vertices and cannot be smoothed");
  }
  const NamedColumn column = columns.require(name, ColumnOwner::Vertices, "column");
  if (column.owner == ColumnOwner::Cells)
  {
    columns.fail("column", '\'' + name + "' is a column of the cells: name one of the vertices");
  }
  if (column.components > 64)
  {
    columns.fail("column", '\'' + name + "' has more than 64 components");
  }
  return column;
}

} // namespace

MeshFairing::MeshFairing(const StoredMesh& mesh, const Smoothing& options)
  : Mesh(mesh)
  , Options(options)
  , Columns(mesh.info(), "smooth")
  , Column(columnOf(options.column, mesh.info().cellType, this->Columns))
  , Held(options.hold,
      boundaryOf(options) == SmoothedBoundary::Fixed ||
        (this->movesPoints() && boundaryOf(options) == SmoothedBoundary::Free),
      this->Columns)
  , Result(std::make_unique<FairedValues>(options, this->Column ? this->Column->components : 3))
  , Job(this->Result->job)
  , Next(this->Result->storage, this->Result->columns())
{
  this->Columns.memory().setLimit(options.memoryLimit);
  // What is not needed takes no memory and no files.
  if (boundaryOf(options) == SmoothedBoundary::Smooth)
  {
    this->Curves.emplace(this->Job.pool);
  }
  if (options.keepEdges)
  {
    this->Presmoothed.emplace(this->Result->storage, 3);
  }
  if (options.keepEdges || (options.keepVolume && this->movesPoints()))
  {
    this->Normals.emplace(this->Result->storage, 3);
  }
}

std::unique_ptr<Solution> MeshFairing::run()
{
  // Shares of the progress: the survey reads the mesh once, a step about ten times.
  const double surveyed = 1.0 / (1.0 + 10.0 * this->Options.steps);
  requireMemory(this->Mesh.info(), this->Result->columns(), Weights::Cotangent, this->Options);
  this->survey({ 0.0, surveyed });
  const int steps = this->Result->vertices() > 0 ? this->Options.steps : 0;
  if (steps > 0 && !this->movesPoints())
  {
    this->smoothColumn({ surveyed, 1.0 });
  }
  for (int k = 0; k < steps && this->movesPoints(); ++k)
  {
    const double all = steps;
    this->step(k, Part{ surveyed, 1.0 }.of(k / all, (k + 1) / all));
  }
  // What is taken from the pool of the result must end before the result does.
  this->Job.endProgress();
  return this->finish();
}

/** Reads the mesh once. */
void MeshFairing::read(Part part, const Visit& visit)
{
  const auto source =
    this->surface().source(this->Columns.vertexColumns(), this->Columns.cellColumns());
  this->Job.read(*source, part, visit);
}

/** The first reading: what is held, the values, the lengths that sizes refer to. */
void MeshFairing::survey(Part part)
{
  const CellType type = this->Mesh.info().cellType;
  StreamCheck check(type);
  MeshMeasures measures(this->Job.pool, type);
  Reservation held(this->Job.pool);
  // Volumes need to know which triangles are wound against each other, which facets tell.
  std::optional<BoundaryFacets> facets;
  if (this->Curves || this->movesPoints())
  {
    facets.emplace(this->Job.pool, type);
  }
  const auto addEdge = [this](std::int64_t low, std::int64_t high, std::int64_t /*none*/)
  {
    if (this->Curves)
    {
      this->Curves->add(low, high);
    }
  };
  this->read(part.of(0.0, 0.6),
    [&](const MeshBlock& block)
    {
      check.add(block);
      measures.add(block);
      this->Held.prepare(block, this->Job.options.scratch);
      held.resize(this->Held.bytes());
      this->keepValues(block);
      if (facets)
      {
        facets->add(block, addEdge);
      }
    });
  check.finish(this->Mesh.info());
  measures.finish();
  this->requireWelded(check);
  this->Held.endPreparing(boundaryOf(this->Options) == SmoothedBoundary::Fixed);
  if (facets)
  {
    facets->finish(addEdge);
  }
  if (this->Curves)
  {
    // The positions of all vertices are known only now: a boundary edge may be found long after its
    // vertices.
    this->Curves->begin(this->Result->values);
    this->holdCurves(part.of(0.6, 0.8));
  }
  this->setSize(measures);
  if (this->movesPoints())
  {
    // Without a closed surface there is no volume, only one that is swept.
    const bool isClosed = !this->Held.hasBoundary() && !this->hasCurves();
    this->Job.report.volume = Report::Volume{};
    this->Job.report.volume->before = isClosed ? measures.volume() : std::nan("");
    if (this->Options.orient || facets->turnedEdges() > 0 ||
        (isClosed && measures.turnedVolume() > 0.0))
    {
      this->orient(part.of(0.8, 1.0));
    }
  }
}

/** Finds how a surface is to be wound, if its triangles are wound against each other, or inwards:
 * the steps are those of the surface that is wound like that. */
void MeshFairing::orient(Part part)
{
  Orientation& winding = this->Result->found.emplace(this->Job.pool, this->Job.options.scratch);
  double from = 0.0;
  winding.find(
    [this, part, &from](const Visit& visit)
    {
      this->read(part.of(from, 0.5 + 0.5 * from), visit);
      from = 0.5;
    });
  Report& report = this->Job.report;
  if (winding.turned() > 0)
  {
    this->Oriented.emplace(this->Mesh, winding);
    const std::string counts = counted(winding.turned(), "triangle was", "triangles were");
    report.notes.push_back(
      this->Options.orient
        ? counts + " turned."
        : counts + " turned to compute with: wound as in the mesh, its bodies have no sides, or "
                   "are inside out. The result is wound as the mesh");
  }
  if (!std::isnan(report.volume->before))
  {
    report.volume->before = winding.volume();
  }
  if (const std::int64_t bodies = winding.unorientable(); bodies > 0)
  {
    report.volume->before = std::nan("");
    report.warn(counted(bodies, "body", "bodies") +
                " cannot be wound so that the surface has two sides: its volume is not known, and "
                "is not kept there");
    return;
  }
  if (const std::int64_t bodies = winding.branched(); bodies > 0)
  {
    report.volume->before = std::nan("");
    report.warn(counted(bodies, "part of the surface ends", "parts of the surface end") +
                " at edges of more than two triangles: which side is outside is not known there, "
                "and the volume neither");
    return;
  }
  if (const std::int64_t bodies = winding.ambiguous(); bodies > 0)
  {
    report.warn(counted(bodies, "closed body lies", "closed bodies lie") +
                " in others without being wound alike: taken as solid, though it may be a cavity");
  }
  this->noteCavities(winding.cavities(), winding.volume() + winding.cavities());
}

/** Warns of cavities, whose volume counts as negative. */
void MeshFairing::noteCavities(double inwards, double outwards)
{
  Report& report = this->Job.report;
  constexpr double Little = 0.01;
  if (std::min(inwards, outwards) > Little * std::max(inwards, outwards))
  {
    report.warn("Some bodies are wound inwards within others, as cavities are: their volume, " +
                std::to_string(std::lround(100.0 * inwards / outwards)) +
                " % of that of the others, counts as negative, and what is kept is the sum");
  }
}

/** Appends the values of a block, which are checked here, where a vertex can be named: one NaN
 * would spread over the whole mesh. */
void MeshFairing::keepValues(const MeshBlock& block)
{
  if (!this->Column)
  {
    this->Result->values.append(block.positions);
    return;
  }
  const auto components = static_cast<std::size_t>(this->Column->components);
  const smg::Column& column = this->Column->in(block);
  this->Values.resize(static_cast<std::size_t>(block.vertices()) * components);
  for (std::size_t k = 0; k < this->Values.size(); ++k)
  {
    this->Values[k] = column.value(k / components, static_cast<int>(k % components));
    if (const char* flaw = flawOf(column.spec.type, this->Values[k]))
    {
      this->Columns.fail("column", '\'' + this->Column->name + "' " + flaw + " at " +
                                     this->Columns.vertexName(block, k / components));
    }
  }
  this->Result->values.append(this->Values);
}

/** Fixes the vertices of the curves that are held. Takes a reading of its own: selections are
 * evaluated block by block, and only after preparation. */
void MeshFairing::holdCurves(Part part)
{
  if (!this->Options.hold.empty() && this->hasCurves())
  {
    this->read(part, [this](const MeshBlock& block)
      { this->Curves->hold(block.firstVertex, this->Held.at(block)); });
  }
}

/** Refuses to smooth positions if most triangles share no edges with others: each would be smoothed
 * by itself, and shrink. For columns, a note is enough. */
void MeshFairing::requireWelded(const StreamCheck& check)
{
  const CellType type = this->Mesh.info().cellType;
  const std::string note = unweldedNote(type, check.vertices(), check.cells());
  if (!note.empty() && this->movesPoints())
  {
    throw Error(note + ": smoothed each for itself they would shrink.");
  }
  noteUnwelded(type, check.vertices(), check.cells(), this->Job.report);
}

/** Sets the size S in the unit of the mesh, and the time step t that follows from it. */
void MeshFairing::setSize(const MeshMeasures& measures)
{
  const SmoothingSize size = this->Options.size;
  const double unit = size.unit == SmoothingSize::MeanEdges  ? measures.meanEdge()
                      : size.unit == SmoothingSize::Diagonal ? measures.diagonal()
                                                             : 1.0;
  this->Size = size.value * unit;
  // A mesh of few cells may be smaller than its default size, which is in its edges.
  constexpr double Most = 0.25;
  if (size.unit == SmoothingSize::MeanEdges && size.value <= SmoothingSize().value &&
      this->Size > measures.diagonal())
  {
    this->Size = Most * measures.diagonal();
    this->Job.report.notes.push_back(
      "The mesh is smaller than the size of the details to smooth in its mean edges: a quarter of "
      "its diagonal, " +
      scientific(this->Size) + ", was smoothed.");
  }
  const double root = this->Size / (2.0 * std::numbers::pi);
  this->Time = (std::exp2(1.0 / this->Options.steps) - 1.0) * root * root;
  // The equations contain t and 1 / t, and their squares are summed. Of a smaller size, positions
  // have no digits.
  const double least = 1e-20 * measures.diagonal();
  if (this->Result->vertices() > 0 &&
      !(std::isnormal(this->Time) && std::isnormal(1.0 / this->Time) && this->Size >= least))
  {
    throw Error(unit > 0.0
                  ? "the size of the details to smooth (option --size), " + scientific(this->Size) +
                      " in the unit of the mesh, is too small or too large to compute with: choose "
                      "one from " +
                      scientific(least) + " to " + scientific(measures.diagonal()) +
                      ", the diagonal of the mesh"
                  : "no cell of the mesh has an area or volume that a size could refer to: "
                    "give the size of the details to smooth (option --size) in the unit of the "
                    "mesh");
  }
  // Most likely a size in a wrong unit: positions would be lost, a column only becomes nearly
  // constant.
  if (this->Size > measures.diagonal())
  {
    const std::string sentence =
      "The size of the details to smooth (option --size), " + scientific(this->Size) +
      ", is larger than the mesh, whose diagonal is " + scientific(measures.diagonal()) +
      ", and leaves little of its shape." +
      (size.unit == SmoothingSize::Mesh ? " Is it in the unit of the mesh?" : "");
    if (this->movesPoints())
    {
      throw Error(sentence);
    }
    this->Job.report.warn(sentence);
  }
}

} // namespace smg
