// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Assembly/CellFlagger.h"

#include "Solver/Core/Vector.h"
#include "smg/CellWeights.h"

#include <algorithm>

// Degenerate and duplicate cells of a stream, block by block, with the vertices that are not final
// and the cells between these in memory. A duplicate has the corners of an earlier cell: they are
// in the window, since it uses them, and the earlier cell is listed under one of them. So every
// duplicate is found, however far apart both are.

namespace smg
{

const std::vector<std::uint8_t>& CellFlagger::flags(const MeshBlock& block)
{
  // The window grows by the vertices of the block and shrinks by those that it declares final.
  for (std::size_t i = 0; i < block.positions.size(); i += 3)
  {
    this->Points.push_back({ block.positions[i], block.positions[i + 1], block.positions[i + 2] });
    this->Cells.emplace_back();
  }
  this->Flags.resize(block.corners.size() / this->Corners);
  for (std::size_t cell = 0; cell < this->Flags.size(); ++cell)
  {
    this->Flags[cell] = this->flag(block.corners.data() + cell * this->Corners);
  }
  for (; this->First < block.finalized && !this->Points.empty(); ++this->First)
  {
    this->Points.pop_front();
    this->Cells.pop_front();
  }
  return this->Flags;
}

std::uint8_t CellFlagger::flag(const std::int64_t* corners)
{
  std::array<std::array<double, 3>, 4> points;
  std::array<std::int64_t, 4> sorted{ -1, -1, -1, -1 };
  for (std::size_t k = 0; k < this->Corners; ++k)
  {
    points[k] = this->Points[static_cast<std::size_t>(corners[k] - this->First)];
    sorted[k] = corners[k];
  }
  std::uint8_t flag = 0;
  if (isDegenerate({ corners, this->Corners }, { points.data(), this->Corners }))
  {
    // Such a cell may be a duplicate as well.
    flag |= DegenerateCell;
    ++this->Degenerate;
  }
  std::sort(sorted.begin(), sorted.end());
  // A cell is listed under one of its corners, the one with the fewest cells, so that the lists
  // stay short around a vertex of very many cells. All corners are searched, as a duplicate may be
  // listed under another one.
  bool duplicate = false;
  CellsOfVertex* shortest = nullptr;
  for (std::size_t k = 0; k < this->Corners && !duplicate; ++k)
  {
    CellsOfVertex& cells = this->Cells[static_cast<std::size_t>(corners[k] - this->First)];
    duplicate = std::find(cells.begin(), cells.end(), sorted) != cells.end();
    shortest = shortest && shortest->size() <= cells.size() ? shortest : &cells;
  }
  if (duplicate)
  {
    flag |= DuplicateCell;
    ++this->Duplicates;
  }
  else
  {
    shortest->push_back(sorted);
  }
  return flag;
}

bool isDegenerate(
  std::span<const std::int64_t> corners, std::span<const std::array<double, 3>> points)
{
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    for (std::size_t k = i + 1; k < corners.size(); ++k)
    {
      if (corners[i] == corners[k])
      {
        return true;
      }
    }
  }
  const CellWeights weights =
    corners.size() == 3
      ? triangleWeights(points[0].data(), points[1].data(), points[2].data())
      : tetrahedronWeights(points[0].data(), points[1].data(), points[2].data(), points[3].data());
  // The weights have a measure of 0 where area or volume are rounding only, which is what a solve
  // goes by, too.
  return weights.measure == 0.0;
}

/** The determinant of the three edges from the first corner. */
double orientedVolume(const std::array<std::array<double, 3>, 4>& p)
{
  const auto edge = [&p](std::size_t k) { return difference(p[k].data(), p[0].data()); };
  return dot(edge(1), cross(edge(2), edge(3)));
}

} // namespace smg
