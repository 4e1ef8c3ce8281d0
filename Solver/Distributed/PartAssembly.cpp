// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/PartAssembly.h"

#include "Solver/Assembly/Edges.h"
#include "Solver/Assembly/RowSums.h"
#include "Solver/Distributed/CheckPart.h"
#include "Solver/Distributed/SharedElements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace smg
{

PartAssembly::PartAssembly(
  Pool& pool, const SharedVertices& vertices, const MeshPart& part, Problem& problem)
  : Vertices(vertices)
  , Part(part)
  , Columns(problem.columns())
  , Kind(problem.weights())
  , Labels(0)
  , Closed(this->Labels)
  , Cells(pool, part.info.cellType, problem, this->Scale, this->Labels, this->Closed)
  , Targets(problem, this->Cells.vertices.points)
{
}

PartSystem PartAssembly::assemble(std::unique_ptr<HypreMatrix> matrix)
{
  const CellType type = this->Part.info.cellType;
  this->Cells.add(this->Part.block);
  checkSharedConditions(this->Vertices, this->Part, this->Cells.vertices);
  joinSharedEdges(this->Vertices, this->Cells.edges);
  if (const OpenFacets* facets = this->Cells.loads.facets())
  {
    this->Cells.loads.exclude(innerFacets(this->Vertices, type, *facets));
  }
  PartSystem system;
  system.matrix = std::move(matrix);
  if (!system.matrix)
  {
    const std::int64_t first = this->Part.firstOwned;
    const HypreRows rows(first, this->Part.endOwned, this->Part.info.vertices);
    const HYPRE_Int usual = type == CellType::Triangle ? 8 : 16;
    system.matrix = std::make_unique<HypreMatrix>(this->Vertices.team(), rows, usual);
    this->Incomplete = system.matrix.get();
  }
  std::vector<double> sums(static_cast<std::size_t>(this->Vertices.vertices() * this->lanes()));
  this->joinScales();
  this->addEdges(sums);
  this->Vertices.addToOwners(sums, this->lanes());
  system.components = std::make_unique<SharedComponents>(
    this->Vertices, this->LabelOf, static_cast<std::int32_t>(this->Labels.labels()), this->Columns);
  this->close(sums, system);
  this->finish(system);
  return system;
}

/** Finds the size of the weights of each vertex, whose cells several parts may have. */
void PartAssembly::joinScales()
{
  this->Scales.assign(static_cast<std::size_t>(this->Vertices.vertices()), 1.0F);
  if (!this->Cells.policy.own())
  {
    return;
  }
  for (std::int64_t i = 0; i < this->Vertices.vertices(); ++i)
  {
    this->Scales[static_cast<std::size_t>(i)] = this->Cells.vertices.scale[i];
  }
  this->Vertices.collect<float>(this->Scales,
    [this](std::int64_t i, float scale)
    {
      float& own = this->Scales[static_cast<std::size_t>(i)];
      own = std::max(own, scale);
    });
  this->Vertices.copyFromOwners(std::span(this->Scales), 1);
}

/** Adds the edges to the matrix and what the part contributes to its vertices to `sums`. */
void PartAssembly::addEdges(std::vector<double>& sums)
{
  for (std::int64_t i = 0; i < this->Vertices.vertices(); ++i)
  {
    double* of = sums.data() + i * this->lanes();
    of[RowSum] = this->Cells.loads.close(i);
    of[Mass] = this->Cells.vertices.mass[i];
    std::copy_n(this->Cells.loads.load(), this->Columns, of + Load);
    this->LabelOf.push_back(this->Cells.parts.close(i, of[Mass]));
    this->addRow(i, of);
  }
}

/** Adds the edges of vertex i, except those that another process has. Edges to prescribed vertices
 * go to the diagonal and the right-hand side. */
void PartAssembly::addRow(std::int64_t i, double* sums)
{
  this->Neighbours.clear();
  try
  {
    this->Cells.edges.take(i, this->Cells.vertices.points, this->Neighbours);
  }
  catch (const EdgeWeightError& error)
  {
    throw EdgeWeightError(error.from, error.to, nameOfVertex(this->Part, error.from),
      nameOfVertex(this->Part, error.to));
  }
  if (this->isKnown(i))
  {
    return;
  }
  this->Places.clear();
  this->Values.clear();
  const std::size_t end = this->Neighbours.size();
  this->Targets.ask(i, this->Neighbours, { &end, 1 });
  for (std::size_t e = 0; e < end; ++e)
  {
    const RowNeighbour& neighbour = this->Neighbours[e];
    const double* target = this->Targets.at(e);
    for (int k = 0; target && k < this->Columns; ++k)
    {
      sums[Load + k] += neighbour.weight * target[k];
    }
    sums[Diagonal] += neighbour.weight;
    const double magnitude = std::fabs(neighbour.weight);
    sums[Terms] += magnitude;
    sums[Ordinary] += std::min(magnitude, this->regularWeight(i, neighbour.to));
    sums[Edges] += 1.0;
    if (!this->isKnown(neighbour.to))
    {
      this->Places.push_back(static_cast<HYPRE_BigInt>(this->Vertices.id(neighbour.to)));
      this->Values.push_back(-neighbour.weight);
      continue;
    }
    const double* value = this->Cells.vertices.values.at(neighbour.to);
    for (int k = 0; k < this->Columns; ++k)
    {
      sums[Load + k] += neighbour.weight * value[k];
    }
  }
  if (!this->Places.empty())
  {
    this->Entries += static_cast<std::int64_t>(this->Places.size());
    this->add(this->Vertices.id(i), this->Places, this->Values);
  }
}

/** The largest weight of the edge that counts in the initial residual of vertex i. */
double PartAssembly::regularWeight(std::int64_t i, std::int64_t to) const
{
  if (this->Kind != Weights::Cotangent)
  {
    return std::numeric_limits<double>::infinity();
  }
  const Ring<double>& points = this->Cells.vertices.points;
  return std::sqrt(squaredRegularWeight(this->Part.info.cellType, points.at(i), points.at(to))) *
         static_cast<double>(this->Scales[static_cast<std::size_t>(i)]);
}

/** Completes the own vertices. */
void PartAssembly::close(const std::vector<double>& sums, PartSystem& system)
{
  const auto own = static_cast<std::size_t>(this->Vertices.end() - this->Vertices.begin());
  const auto columns = static_cast<std::size_t>(this->Columns);
  system.x.assign(columns, std::vector<double>(own));
  system.b = system.x;
  system.share.assign(own, 0.0);
  system.mass.assign(own, 0.0);
  system.termSquares.assign(columns, 0.0);
  this->Diagonals.assign(own, 1.0);
  this->IsUnknown.assign(own, 0);
  for (std::size_t k = 0; k < own; ++k)
  {
    const std::int64_t i = this->Vertices.begin() + static_cast<std::int64_t>(k);
    const double* of = sums.data() + i * this->lanes();
    const double* value = this->Cells.vertices.values.at(i);
    for (std::size_t c = 0; c < columns; ++c)
    {
      system.x[c][k] = system.b[c][k] = value[c];
    }
    const SharedComponents::Place place = system.components->of(static_cast<std::int64_t>(k));
    const bool isKnown = this->isKnown(i);
    const bool isHeld = !isKnown && of[Edges] == 0.0 && of[RowSum] == 0.0;
    this->Prescribed += isKnown ? 1 : 0;
    if (isHeld)
    {
      system.undetermined.push_back(static_cast<std::int64_t>(k));
    }
    if (place.components && (isKnown || isHeld || of[RowSum] > 0.0))
    {
      place.components->anchor(place.label);
    }
    if (!isKnown && !isHeld)
    {
      this->closeUnknown(static_cast<std::int64_t>(k), of, system);
    }
  }
}

/** Completes the equation of own vertex k. */
void PartAssembly::closeUnknown(std::int64_t k, const double* sums, PartSystem& system)
{
  const auto row = static_cast<std::size_t>(k);
  const double edges = sums[Diagonal];
  const double raise = this->Kind == Weights::Cotangent ? lostDiagonalOf(sums[RowSum] + edges,
                                                            std::fabs(sums[RowSum]) + sums[Terms])
                                                        : 0.0;
  this->Raised += raise > 0.0 ? 1 : 0;
  this->IsUnknown[row] = 1;
  this->Diagonals[row] = sums[RowSum] + edges + raise;
  system.mass[row] = sums[Mass];
  system.share[row] = commonShare(sums[RowSum] + (sums[Terms] - sums[Ordinary]), sums[Ordinary]);
  std::vector<double> x(static_cast<std::size_t>(this->Columns));
  for (std::size_t c = 0; c < x.size(); ++c)
  {
    x[c] = system.x[c][row];
    // What keeps the vertex near its initial value is no part of the problem.
    system.b[c][row] = sums[Load + c] + raise * x[c];
  }
  const SharedComponents::Place place = system.components->of(k);
  if (place.components)
  {
    const std::vector<double> none(x.size());
    place.components->count(place.label, sums + Load, x.data(), none.data(), sums[Mass]);
  }
}

/** Makes components without constraint solvable, and completes the matrix. */
void PartAssembly::finish(PartSystem& system)
{
  system.components->combine();
  const SharedComponents::Shifts shifts = system.components->rightSideShifts();
  const auto own = static_cast<std::int64_t>(this->Diagonals.size());
  for (std::int64_t k = 0; k < own; ++k)
  {
    const auto row = static_cast<std::size_t>(k);
    const SharedComponents::Place place = system.components->of(k);
    for (int c = 0; c < this->Columns; ++c)
    {
      const auto column = static_cast<std::size_t>(c);
      if (this->IsUnknown[row] && place.components)
      {
        system.b[column][row] -= place.components->weightOf(place.label, system.mass[row]) *
                                 shifts(place, this->Columns, c);
      }
      const double terms[2] = { system.b[column][row],
        this->Diagonals[row] * system.x[column][row] };
      system.termSquares[column] +=
        this->IsUnknown[row] ? terms[0] * terms[0] + terms[1] * terms[1] : 0.0;
    }
  }
  // A larger diagonal of one unknown of a free component makes the matrix definite. The sum of its
  // equations then says that the correction is zero there: the solution remains one of the problem.
  const auto isUnknown = [this](std::int64_t k)
  { return this->IsUnknown[static_cast<std::size_t>(k)] != 0; };
  for (const std::int64_t k : system.components->representatives(isUnknown))
  {
    this->Diagonals[static_cast<std::size_t>(k)] *= 2.0;
  }
  for (std::int64_t k = 0; k < own; ++k)
  {
    const auto row = static_cast<HYPRE_BigInt>(this->Part.firstOwned + k);
    this->add(row, { &row, 1 }, { &this->Diagonals[static_cast<std::size_t>(k)], 1 });
  }
  if (this->Incomplete)
  {
    this->Incomplete->assemble();
  }
  this->count(system);
}

/** Adds to a row of the matrix, unless that is taken as it is. */
void PartAssembly::add(
  std::int64_t row, std::span<const HYPRE_BigInt> columns, std::span<const double> values)
{
  if (this->Incomplete)
  {
    this->Incomplete->add(static_cast<HYPRE_BigInt>(row), columns, values);
  }
}

/** Sums up what the processes have counted. */
void PartAssembly::count(PartSystem& system) const
{
  Team& team = this->Vertices.team();
  const StiffnessRules& policy = this->Cells.policy;
  const auto cells = static_cast<std::int64_t>(this->Part.block.corners.size()) /
                     cornersOf(this->Part.info.cellType);
  const std::int64_t unknowns = std::ranges::count(this->IsUnknown, 1);
  std::int64_t counts[] = { cells, this->Prescribed,
    static_cast<std::int64_t>(system.undetermined.size()), this->Raised, policy.degenerateCells(),
    this->Cells.edges.clamped(), policy.limitedCells(), unknowns, this->Entries + unknowns,
    policy.coincidentCells() };
  team.sum(counts);
  double flatness = policy.minFlatness();
  team.least({ &flatness, 1 });
  team.sum(system.termSquares);
  AssemblyCounts& all = system.counts;
  all.type = this->Part.info.cellType;
  all.vertices = this->Part.info.vertices;
  all.cells = counts[0];
  all.prescribed = counts[1];
  all.held = counts[2];
  all.raisedRows = counts[3];
  all.degenerateCells = counts[4];
  all.coincidentCells = counts[9];
  all.clampedWeights = counts[5];
  all.limitedCells = counts[6];
  all.minFlatness = flatness;
  system.unknowns = counts[7];
  system.nonzeros = counts[8];
  all.components = system.components->components();
  all.freeComponents = system.components->freeComponents();
  all.termSquares = *std::ranges::max_element(system.termSquares);
}

} // namespace smg
