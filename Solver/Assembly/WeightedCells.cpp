// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/WeightedCells.h"

#include "Solver/Assembly/Elements.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

// The weights of a cell: those of finite elements or of the problem, scaled down where the cell is
// too flat (see flatnessFactor()). They depend on this cell only, so that blocks, batches and
// threads change nothing. The time per cell is constant.

namespace smg
{

/** Flagged cells and those that use a vertex twice have no weights, whatever the problem sets. */
void WeightedCells::weigh(WeightedCell& cell, const OpenVertices& vertices) const
{
  const int count = cornersOf(this->Type);
  for (int k = 0; k < count; ++k)
  {
    cell.points[k] = vertices.points.at(cell.corners[k]);
    cell.nodes[k] = cell.corners[k];
  }
  if (vertices.ties.any())
  {
    for (int k = 0; k < count; ++k)
    {
      cell.nodes[k] = vertices.ties.node(cell.corners[k]);
      cell.jumps[k] = vertices.ties.jump(cell.corners[k]);
    }
  }
  const bool hasWeights = cell.flags == 0 && !hasRepeatedCorner(cell.corners, count);
  cell.weights = !hasWeights  ? CellWeights()
                 : this->Data ? this->Data->weights()
                              : cellWeights(this->Type, cell.points);
  cell.scale = this->Data ? this->Data->scale() : 1.0;
  cell.flatness = 1.0;
  cell.connects = true;
  if (cell.weights.measure == 0.0)
  {
    cell.connects = this->ConnectsFlat && isDistinctCell(cell.corners, count, cell.flags);
  }
  // The other kinds of weights are positive after EdgeStiffness, so nothing cancels in their rows.
  else if (this->Kind == Weights::Cotangent)
  {
    cell.flatness =
      this->Data ? this->Data->flatness() : flatnessFactor(this->Type, cell.points, cell.weights);
  }
}

void CellCounts::add(CellType type, const WeightedCell& cell)
{
  if (cell.weights.measure == 0.0)
  {
    const int count = cornersOf(type);
    ++this->degenerate;
    // Distinct vertices at one place: the mesh looks closed there and is not, which the report
    // warns of.
    const bool joins =
      isDistinctCell(cell.corners, count, cell.flags) && hasCoincidentCorners(cell.points, count);
    this->coincident += joins ? 1 : 0;
    this->measures.addLost(cell.points, count);
    return;
  }
  this->measures.largest = std::max(this->measures.largest, cell.weights.measure);
  this->limited += cell.flatness < 1.0 ? 1 : 0;
  this->minFlatness = std::min(this->minFlatness, cell.flatness);
}

namespace
{

/** Products of four lengths must be numbers, and for tetrahedra, whose weights have the unit of
 * length, products and inverses in single precision. */
constexpr double LargestLength = 1e70, LargestWeight = 1e25;

bool isWithin(double size, double largest)
{
  return size >= 1.0 / largest && size <= largest;
}

} // namespace

void MeasureRange::addLost(const double* const* corners, int count)
{
  double length = 0.0;
  for (int k = 1; k < count; ++k)
  {
    for (int d = 0; d < 3; ++d)
    {
      length = std::max(length, std::fabs(corners[k][d] - corners[0][d]));
    }
  }
  this->lost += length > 0.0 && !isWithin(length, LargestLength) ? 1 : 0;
}

void MeasureRange::check(CellType type) const
{
  const bool isSurface = type == CellType::Triangle;
  const double length = isSurface ? std::sqrt(this->largest) : std::cbrt(this->largest);
  const double most = this->areWeights && !isSurface ? LargestWeight : LargestLength;
  if (this->largest > 0.0 ? !isWithin(length, most) : this->lost > 0)
  {
    throw Error(
      std::string("the cells of the mesh are too small or too large for numbers of double "
                  "precision: scale the mesh, so that their edges are within ") +
      (isSurface ? "1e-70 to 1e70" : "1e-25 to 1e25"));
  }
}

void addFieldLoads(const WeightedCell& cell, CellType type, int columns, double* const* load)
{
  const double* field = cell.data->field();
  // Without a field, the gradients are not needed.
  if (std::all_of(field, field + 3 * columns, [](double q) { return q == 0.0; }))
  {
    return;
  }
  // The gradients are constant in a cell, so the integral is the product with its measure.
  const double weight = cell.flatness * cell.weights.measure;
  const CellGradients gradients(type, cell.points);
  for (int c = 0; c < cornersOf(type); ++c)
  {
    for (int k = 0; k < columns; ++k)
    {
      load[c][k] +=
        weight * dot({ field[3 * k], field[3 * k + 1], field[3 * k + 2] }, gradients[c]);
    }
  }
}

} // namespace smg
