// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/ProblemCells.h"

#include "Solver/Assembly/Elements.h"
#include "Solver/Mesh/AddedColumn.h"
#include "Solver/Mesh/VisitCells.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

// The data of a problem in its cells. The problem is asked for a batch of consecutive cells of a
// block in one call; its numbers are checked here, where the cell can still be named. They depend
// on one cell only: blocks, batches and threads change nothing. The time per cell is constant; the
// memory holds one batch.

namespace smg
{
namespace
{

double largest(const CellWeights& cell, int edges)
{
  return *std::max_element(cell.weight, cell.weight + edges);
}

bool allFinite(const double* values, std::size_t count)
{
  return std::all_of(values, values + count, [](double value) { return std::isfinite(value); });
}

std::string nameOf(const MeshBlock& block, std::size_t c)
{
  return "cell " + nameOfRow(block.cellColumns, OriginalCellIdSpec, block.firstCell, c);
}

} // namespace

ProblemCells::ProblemCells(Problem& problem, CellType type, bool conductivities)
  : Given(problem)
  , Type(type)
  , Kind(problem.weights())
  , Columns(static_cast<std::size_t>(problem.columns()))
  , Conductivities(conductivities)
  , Parts(problem.conditionCounts().parts)
{
}

/** Queries the problem for the batch that begins with cell `first` of the block. */
void ProblemCells::ask(const MeshBlock& block, std::size_t first, const Ring<double>& points)
{
  this->gather(block, first, points);
  const auto corners = static_cast<std::size_t>(cornersOf(this->Type));
  CellBatch batch{ .type = this->Type,
    .block = block,
    .first = first,
    .corners = std::span(block.corners).subspan(first * corners, this->Cells.size() * corners),
    .points = this->Points,
    .weight = this->Weight,
    .measure = this->Measure,
    .screening = {},
    .source = {},
    .field = this->Field,
    .conductivity = this->Conductivity,
    .part = this->Part };
  for (std::size_t k = 0; k < Densities.size(); ++k)
  {
    batch.*Densities[k].inCells = this->Values[k];
  }
  this->Given.cells(batch);
  for (std::size_t k = 0; k < this->Cells.size(); ++k)
  {
    this->take(k, block, first + k);
  }
}

/** Sets what a batch contains before the problem sees it: the weights of finite elements with K =
 * 1, and zeros. */
void ProblemCells::gather(const MeshBlock& block, std::size_t first, const Ring<double>& points)
{
  const int corners = cornersOf(this->Type);
  const std::size_t cells = std::min(BatchCells, cellsOf(this->Type, block) - first);
  this->Cells.resize(cells);
  this->Points.clear();
  this->Weight.clear();
  this->Measure.clear();
  for (std::size_t k = 0; k < Densities.size(); ++k)
  {
    this->Values[k].assign(cells * this->numbersOf(Densities[k]), 0.0);
  }
  this->Field.assign(3 * cells * this->Columns, 0.0);
  this->Part.assign(cells, -1);
  const std::int64_t* corner = block.corners.data() + first * static_cast<std::size_t>(corners);
  for (Cell& cell : this->Cells)
  {
    const double* point[4] = {};
    for (int k = 0; k < corners; ++k)
    {
      point[k] = points.at(*corner++);
      this->Points.insert(this->Points.end(), point[k], point[k] + 3);
    }
    cell.weights = cellWeights(this->Type, point);
    cell.scale = 1.0;
    // Of the geometry alone, before the problem changes the weights: so it does not depend on the
    // unit of a conductivity.
    cell.flatness =
      this->Kind == Weights::Cotangent ? flatnessFactor(this->Type, point, cell.weights) : 1.0;
    this->Weight.insert(
      this->Weight.end(), cell.weights.weight, cell.weights.weight + edgesOf(this->Type));
    this->Measure.push_back(cell.weights.measure);
  }
  // Only results ask for K itself; a solve needs no more than the weights.
  constexpr double Identity[6] = { 1.0, 1.0, 1.0, 0.0, 0.0, 0.0 };
  this->Conductivity.clear();
  for (std::size_t k = 0; this->Conductivities && k < cells; ++k)
  {
    this->Conductivity.insert(this->Conductivity.end(), Identity, Identity + 6);
  }
}

/** Reads what the problem has set for cell k of the batch, which is cell c of the block. */
void ProblemCells::take(std::size_t k, const MeshBlock& block, std::size_t c)
{
  CellWeights& cell = this->Cells[k].weights;
  const double measure = this->Measure[k];
  if (cell.measure == 0.0 || measure == 0.0)
  {
    // Degenerate, or without weight by the problem's choice. Its other data are neither used nor
    // checked.
    cell = {};
    return;
  }
  this->takeWeights(k, block, c);
  this->requireValid(k, block, c);
}

/** Replaces the weights of finite elements by those of the problem, and notes the ratio of their
 * sizes. */
void ProblemCells::takeWeights(std::size_t k, const MeshBlock& block, std::size_t c)
{
  CellWeights& cell = this->Cells[k].weights;
  const auto edges = static_cast<std::size_t>(edgesOf(this->Type));
  const double* weight = this->Weight.data() + k * edges;
  // The weights at a corner sum to its positive diagonal entry: so the largest one is positive.
  const double before = largest(cell, edgesOf(this->Type));
  const double after = *std::max_element(weight, weight + edges);
  // With uniform weights, the weights of cells are ignored.
  const bool seen = this->Kind != Weights::Uniform;
  cell.measure = this->Measure[k];
  if (!std::isfinite(cell.measure) || cell.measure < 0.0 ||
      (seen && !(allFinite(weight, edges) && after > 0.0)))
  {
    throw Error("the problem's weights of " + nameOf(block, c) +
                " are not valid: they must be finite, at least one of them positive, and the "
                "measure not negative");
  }
  // Coarse levels compute in single precision, which must represent inverses and products of
  // weights.
  if (seen && !(after >= 1e-20 && after <= 1e20))
  {
    throw Error("the weights of " + nameOf(block, c) +
                " are outside 1e-20 to 1e20: scale the conductivity or the weights of the problem");
  }
  std::copy_n(weight, edges, cell.weight);
  this->Cells[k].scale = after / before;
}

void ProblemCells::requireValid(std::size_t k, const MeshBlock& block, std::size_t c) const
{
  for (std::size_t d = 0; d < Densities.size(); ++d)
  {
    const Density& density = Densities[d];
    const std::size_t numbers = this->numbersOf(density);
    if (density.findInvalid(this->Values[d].data() + k * numbers, numbers) >= 0)
    {
      throw Error(
        std::string("the ") + density.name + " of " + nameOf(block, c) + density.complaint());
    }
  }
  if (!allFinite(this->Field.data() + 3 * k * this->Columns, 3 * this->Columns))
  {
    throw Error("the field of " + nameOf(block, c) + " is not a finite number");
  }
  if (this->Part[k] < -1 || this->Part[k] >= this->Parts)
  {
    throw Error("the problem's part of " + nameOf(block, c) + " is " +
                std::to_string(this->Part[k]) + ", of " + std::to_string(this->Parts));
  }
}

} // namespace smg
