// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/PartAssembly.h"

#include "Solver/Assembly/Edges.h"
#include "Solver/Assembly/RowSums.h"
#include "Solver/Distributed/CheckPart.h"
#include "Solver/Distributed/SharedElements.h"
#include "Solver/Mesh/VisitCells.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

// The matrix and right-hand sides of a mesh in parts. The weights, loads and masses of cells come
// from the code of the streaming engine (CellAssembly); here they are joined across parts.
//
// Invariant: every edge of the mesh has one process that adds it to both of its rows, with the
// weight summed over the cells of all parts; what belongs to vertices is summed at their owners,
// which add the diagonals. So the matrix is symmetric, and its row sums equal those of a solve of
// one stream up to rounding, whoever has the cells. Prescribed vertices are eliminated
// symmetrically: their edges go to diagonals and right-hand sides alone, and their rows have 1 on
// the diagonal.
//
// A second problem with the same matrix goes the same way and adds nothing to the matrix.

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
  // The order matters: data are compared before they are used; edges and facets are joined before
  // rows are made from them.
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
    // Usual numbers of entries of a row, as a hint for the memory.
    const HYPRE_Int usual = type == CellType::Triangle ? 8 : 16;
    system.matrix = std::make_unique<HypreMatrix>(this->Vertices.team(), rows, usual);
    this->Incomplete = system.matrix.get();
  }
  std::vector<double> sums(static_cast<std::size_t>(this->Vertices.vertices() * this->lanes()));
  // Each lane of `sums` is the contribution of this part; the owners get the sums over all parts.
  this->joinScales();
  this->addEdges(sums);
  this->Vertices.addToOwners(sums, this->lanes());
  // Components of the part alone, from its cells, are joined with the components of other parts.
  system.components = std::make_unique<SharedComponents>(
    this->Vertices, this->LabelOf, static_cast<std::int32_t>(this->Labels.labels()), this->Columns);
  this->close(sums, system);
  this->finish(system);
  return system;
}

/** Finds the largest scale of the weights at each vertex, over the cells of all parts. Only
 * problems with weights of their own have other scales than 1. */
void PartAssembly::joinScales()
{
  this->Scales.assign(static_cast<std::size_t>(this->Vertices.vertices()), 1.0F);
  if (!this->Cells.cells.hasData())
  {
    return;
  }
  for (std::int64_t i = 0; i < this->Vertices.vertices(); ++i)
  {
    this->Scales[static_cast<std::size_t>(i)] = this->Cells.vertices.scale[i];
  }
  // The largest at the owner, and from there to all parts.
  this->Vertices.collect<float>(this->Scales,
    [this](std::int64_t i, float scale)
    {
      float& own = this->Scales[static_cast<std::size_t>(i)];
      own = std::max(own, scale);
    });
  this->Vertices.copyFromOwners(std::span(this->Scales), 1);
}

/** Adds the edges to the matrix, and to `sums` what the part contributes to each of its
 * vertices. */
void PartAssembly::addEdges(std::vector<double>& sums)
{
  // In ascending order, which OpenEdges needs: it passes an edge on from its lower to its upper
  // vertex.
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
 * go to the diagonal and the right-hand side. The row may belong to another process. */
void PartAssembly::addRow(std::int64_t i, double* sums)
{
  this->Neighbours.clear();
  try
  {
    this->Cells.edges.take(i, this->Cells.vertices.points, this->Neighbours);
  }
  // Named by the numbers of the original file, which the user knows.
  catch (const EdgeWeightError& error)
  {
    throw EdgeWeightError(error.from, error.to, nameOfVertex(this->Part, error.from),
      nameOfVertex(this->Part, error.to));
  }
  // The edges are taken nevertheless, since they must be passed on to their upper vertices.
  if (this->isKnown(i))
  {
    return;
  }
  this->Places.clear();
  this->Values.clear();
  // All targets of a row are asked for at once.
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
    // An edge counts in the diagonal whether its other end is an unknown or prescribed.
    sums[Diagonal] += neighbour.weight;
    const double magnitude = std::fabs(neighbour.weight);
    sums[Terms] += magnitude;
    sums[Ordinary] += std::min(magnitude, this->regularWeight(i, neighbour.to));
    sums[Edges] += 1.0;
    if (!this->isKnown(neighbour.to))
    {
      // A column of hypre is a stream index: vertices are numbered as in the whole mesh.
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

/** The largest weight with which the edge counts in the initial residual of vertex i, see
 * commonShare(). Other weights than cotangents have no outliers. */
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

/** Completes the equations of the own vertices, given the sums over all parts. */
void PartAssembly::close(const std::vector<double>& sums, PartSystem& system)
{
  const auto own = static_cast<std::size_t>(this->Vertices.end() - this->Vertices.begin());
  const auto columns = static_cast<std::size_t>(this->Columns);
  system.x.assign(columns, std::vector<double>(own));
  system.b = system.x;
  system.share.assign(own, 0.0);
  system.mass.assign(own, 0.0);
  system.termSquares.assign(columns, 0.0);
  system.roundingSquares.assign(columns, 0.0);
  // Rows that are not unknowns are x = value: 1 on the diagonal.
  this->Diagonals.assign(own, 1.0);
  this->RowSums.assign(own, 0.0);
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
    // No edge and nothing else in the row: the value is determined by nothing and stays as it is.
    const bool isHeld = !isKnown && of[Edges] == 0.0 && of[RowSum] == 0.0;
    this->Prescribed += isKnown ? 1 : 0;
    if (isHeld)
    {
      system.undetermined.push_back(static_cast<std::int64_t>(k));
    }
    const bool isLoose = !isKnown && of[RowSum] > 0.0 && Components::isLoose(of[RowSum], of[Terms]);
    // What makes a component solvable: a vertex whose value is known, or a diagonal beyond the
    // edges, though one that is lost in rounding holds it only together with others.
    if (place.components && isLoose)
    {
      place.components->hold(place.label, of[RowSum], of[Terms]);
    }
    else if (place.components && (isKnown || isHeld || of[RowSum] > 0.0))
    {
      place.components->anchor(place.label);
    }
    if (!isKnown && !isHeld)
    {
      system.mass[k] = isLoose ? -of[RowSum] : of[Mass];
      this->closeUnknown(static_cast<std::int64_t>(k), of, system);
    }
  }
}

/** Completes the equation of own vertex k. */
void PartAssembly::closeUnknown(std::int64_t k, const double* sums, PartSystem& system)
{
  const auto row = static_cast<std::size_t>(k);
  // Cotangents have both signs: a diagonal that is smaller than the rounding of its terms is
  // raised, see lostDiagonalOf().
  const double edges = sums[Diagonal];
  const double raise = this->Kind == Weights::Cotangent ? lostDiagonalOf(sums[RowSum] + edges,
                                                            std::fabs(sums[RowSum]) + sums[Terms])
                                                        : 0.0;
  this->Raised += raise > 0.0 ? 1 : 0;
  this->IsUnknown[row] = 1;
  this->Diagonals[row] = sums[RowSum] + edges + raise;
  this->RowSums[row] = sums[RowSum];
  system.share[row] = commonShare(sums[RowSum] + (sums[Terms] - sums[Ordinary]), sums[Ordinary]);
  std::vector<double> x(static_cast<std::size_t>(this->Columns));
  for (std::size_t c = 0; c < x.size(); ++c)
  {
    x[c] = system.x[c][row];
    // What keeps the vertex near its initial value is not part of the problem: it is on both sides
    // of the equation.
    system.b[c][row] = sums[Load + c] + raise * x[c];
  }
  const SharedComponents::Place place = system.components->of(k);
  if (place.components)
  {
    // Components would also sum residuals, which are not needed here.
    const std::vector<double> none(x.size());
    place.components->count(place.label, sums + Load, x.data(), none.data(), system.mass[row]);
  }
}

/** Makes components without constraint solvable, and completes the matrix. For those the right-hand
 * side must sum to zero: the mean of the source is subtracted. Of a component that is held loosely
 * the part beside its constant is solved for, see Components. */
void PartAssembly::finish(PartSystem& system)
{
  system.components->combine();
  const SharedComponents::Shifts shifts = system.components->rightSideShifts();
  const SharedComponents::Shifts means = system.components->initialMeans();
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
        system.x[column][row] -= means(place, this->Columns, c);
      }
      // The rounding of the residual grows with the terms of b - A x, not with their difference.
      const double terms[2] = { system.b[column][row],
        this->Diagonals[row] * system.x[column][row] };
      const double squares = this->IsUnknown[row] ? terms[0] * terms[0] + terms[1] * terms[1] : 0.0;
      const double counted = residualShare(system.share[row]);
      system.termSquares[column] += squares;
      system.roundingSquares[column] += counted * counted * squares;
      this->AnyTerm =
        this->AnyTerm ||
        (this->IsUnknown[row] && (system.b[column][row] != 0.0 || system.x[column][row] != 0.0));
    }
  }
  // A component that is free, or held by next to nothing, has a singular matrix: constants are in
  // its kernel. With the diagonal of one of its unknowns doubled it is definite. The sum of its
  // equations, whose right-hand sides sum to zero, then says that this unknown is zero: the
  // solution remains one of the problem, and fix() gives it its mean.
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
  this->measure(system);
  this->count(system);
}

/** Finds the best constant c of each column, and then ||b - A c||: A c is c times the row sums. */
void PartAssembly::measure(PartSystem& system) const
{
  const auto columns = static_cast<std::size_t>(this->Columns);
  // A column whose solution is constant is measured against that.
  constexpr double Rounding = 1e-13;
  std::vector<double> constants(columns), sums(columns + 1), squares(columns);
  const auto forRows = [&](auto&& add)
  {
    for (std::size_t row = 0; row < this->RowSums.size(); ++row)
    {
      for (std::size_t c = 0; this->IsUnknown[row] && c < columns; ++c)
      {
        add(c, system.share[row] * this->RowSums[row], system.share[row] * system.b[c][row]);
      }
    }
  };
  forRows(
    [&](std::size_t c, double w, double b)
    {
      sums[c] += w * b;
      sums[columns] += c == 0 ? w * w : 0.0;
    });
  Team& team = this->Vertices.team();
  team.sum(sums);
  for (std::size_t c = 0; sums[columns] > 0.0 && c < columns; ++c)
  {
    constants[c] = sums[c] / sums[columns];
  }
  system.references.assign(columns, 0.0);
  forRows(
    [&](std::size_t c, double w, double b)
    {
      const double rest = b - constants[c] * w;
      system.references[c] += rest * rest;
      squares[c] += b * b;
    });
  team.sum(system.references);
  team.sum(squares);
  for (std::size_t c = 0; c < columns; ++c)
  {
    const double rest = std::sqrt(system.references[c]), all = std::sqrt(squares[c]);
    system.references[c] = rest > Rounding * all ? rest : all;
  }
}

/** Adds to a row of the matrix, unless that is complete from an earlier problem. */
void PartAssembly::add(
  std::int64_t row, std::span<const HYPRE_BigInt> columns, std::span<const double> values)
{
  if (this->Incomplete)
  {
    this->Incomplete->add(static_cast<HYPRE_BigInt>(row), columns, values);
  }
}

/** Sums what the processes have counted, in one reduction for all counts. */
void PartAssembly::count(PartSystem& system) const
{
  Team& team = this->Vertices.team();
  AssemblyCounts& all = system.counts;
  CellCounts& ofCells = all.ofCells;
  all.type = this->Part.info.cellType;
  all.vertices = this->Part.info.vertices;
  all.cells = static_cast<std::int64_t>(cellsOf(all.type, this->Part.block));
  all.prescribed = this->Prescribed;
  all.held = static_cast<std::int64_t>(system.undetermined.size());
  all.raisedRows = this->Raised;
  all.clampedWeights = this->Cells.edges.clamped();
  ofCells = this->Cells.counts;
  system.unknowns = std::ranges::count(this->IsUnknown, 1);
  system.nonzeros = this->Entries + system.unknowns;
  std::int64_t withTerms = this->AnyTerm ? 1 : 0;
  std::int64_t* const places[] = { &all.cells, &all.prescribed, &all.held, &all.raisedRows,
    &all.clampedWeights, &ofCells.degenerate, &ofCells.coincident, &ofCells.limited,
    &ofCells.measures.lost, &system.unknowns, &system.nonzeros, &withTerms };
  std::int64_t sums[std::size(places)];
  std::ranges::transform(places, sums, [](const std::int64_t* place) { return *place; });
  team.sum(sums);
  for (std::size_t k = 0; k < std::size(places); ++k)
  {
    *places[k] = sums[k];
  }
  all.anyTerm = withTerms > 0;
  team.least({ &ofCells.minFlatness, 1 });
  team.largest({ &ofCells.measures.largest, 1 });
  team.sum(system.termSquares);
  team.sum(system.roundingSquares);
  all.components = system.components->components();
  all.freeComponents = system.components->freeComponents();
  // Of the column with the largest terms.
  all.termSquares = *std::ranges::max_element(system.termSquares);
}

} // namespace smg
