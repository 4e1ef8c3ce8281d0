// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/OwnWeights.h"

#include "Solver/Core/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace smg
{
namespace
{

double largest(const CellWeights& cell, int edges)
{
  return *std::max_element(cell.weight, cell.weight + edges);
}

} // namespace

/** Asks the problem for the weights of the batch that begins with cell `first` of the block. */
void OwnWeights::ask(const MeshBlock& block, std::size_t first, const Ring<double>& points)
{
  this->gather(block, first, points);
  const auto corners = static_cast<std::size_t>(cornersOf(this->Type));
  CellBatch batch{ this->Type, block, first,
    std::span(block.corners).subspan(first * corners, this->Cells.size() * corners), this->Points,
    this->Weight, this->Measure, this->Screening, this->Source, this->Field, {} };
  this->Given.cells(batch);
  for (std::size_t k = 0; k < this->Cells.size(); ++k)
  {
    this->take(k, block.firstCell + static_cast<std::int64_t>(first + k));
  }
}

/** The batch's points and the weights of finite elements. */
void OwnWeights::gather(const MeshBlock& block, std::size_t first, const Ring<double>& points)
{
  const int corners = cornersOf(this->Type);
  const int edges = edgesOf(this->Type);
  const std::size_t all = block.corners.size() / static_cast<std::size_t>(corners);
  this->Cells.resize(std::min(BatchCells, all - first));
  this->CellScales.resize(this->Cells.size());
  this->Points.clear();
  this->Weight.clear();
  this->Measure.clear();
  const auto columns = static_cast<std::size_t>(this->Given.columns());
  this->Screening.assign(this->Cells.size(), 0.0);
  this->Source.assign(columns * this->Cells.size(), 0.0);
  this->Field.assign(3 * columns * this->Cells.size(), 0.0);
  const std::int64_t* corner = block.corners.data() + first * static_cast<std::size_t>(corners);
  for (CellWeights& cell : this->Cells)
  {
    const double* point[4] = {};
    for (int k = 0; k < corners; ++k)
    {
      point[k] = points.at(*corner++);
      this->Points.insert(this->Points.end(), point[k], point[k] + 3);
    }
    cell = cellWeights(this->Type, point);
    this->Weight.insert(this->Weight.end(), cell.weight, cell.weight + edges);
    this->Measure.push_back(cell.measure);
  }
}

/** Takes what the problem says of cell k of the batch, number `number` of the stream. */
void OwnWeights::take(std::size_t k, std::int64_t number)
{
  CellWeights& cell = this->Cells[k];
  const double measure = this->Measure[k];
  if (cell.measure == 0.0 || measure == 0.0)
  {
    cell = {};
    return;
  }
  const int edges = edgesOf(this->Type);
  const double before = largest(cell, edges);
  std::copy_n(this->Weight.data() + k * static_cast<std::size_t>(edges), edges, cell.weight);
  const bool finite = std::all_of(
    cell.weight, cell.weight + edges, [](double weight) { return std::isfinite(weight); });
  if (!finite || !std::isfinite(measure) || measure < 0.0 || !(largest(cell, edges) > 0.0))
  {
    throw Error("the problem's weights of cell " + std::to_string(number) +
                " are not valid: they must be finite, at least one of them positive, and the "
                "measure not negative");
  }
  cell.measure = measure;
  this->CellScales[k] = largest(cell, edges) / before;
}

void OwnWeights::connect(std::int64_t a, std::int64_t b)
{
  double& least = this->Scales.weight(a, b);
  if (this->cell().measure > 0.0)
  {
    const double scale = this->CellScales[this->Current];
    least = least > 0.0 ? std::min(least, scale) : scale;
  }
}

const std::vector<OpenEdge>& OwnWeights::takeScales(std::int64_t from)
{
  this->Scales.take(from, this->Row);
  for (OpenEdge& edge : this->Row)
  {
    edge.weight = edge.weight > 0.0 ? edge.weight : 1.0;
  }
  return this->Row;
}

void OwnWeights::requireRange(double weight, std::int64_t i, std::int64_t j)
{
  if (!(weight >= 1e-20 && weight <= 1e20))
  {
    throw Error("the weight of the edge between vertices " + std::to_string(i) + " and " +
                std::to_string(j) + " is outside 1e-20 to 1e20: scale the weights of the problem");
  }
}

} // namespace smg
