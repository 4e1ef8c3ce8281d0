// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/Order/OrderedVertices.h"
#include "IO/Raw/RawMesh.h"

#include <array>
#include <cstdint>

namespace smg
{

/**
 * A cell by the places of its corners in an order of the vertices, the largest first. `turn` has
 * the corner of the file that each of them is, two bits each.
 */
template <int Corners>
struct PlacedCell
{
  std::array<std::uint32_t, Corners> places;
  std::uint32_t element; ///< of the file
  std::uint32_t turn;

  auto operator<=>(const PlacedCell&) const = default;

  /** The places in the file's sequence of corners. */
  std::array<std::uint32_t, Corners> inFile() const
  {
    std::array<std::uint32_t, Corners> result;
    for (int k = 0; k < Corners; ++k)
    {
      result[this->turn >> 2 * k & 3] = this->places[k];
    }
    return result;
  }
};

/** The cell with these numbers of its corners, in the file's sequence. */
template <int Corners>
PlacedCell<Corners> placedCell(const std::uint32_t* numbers, std::uint32_t element)
{
  PlacedCell<Corners> cell{ {}, element, 0 };
  std::array<std::uint8_t, Corners> corner;
  for (int k = 0; k < Corners; ++k)
  {
    int i = k;
    for (; i > 0 && cell.places[i - 1] < numbers[k]; --i)
    {
      cell.places[i] = cell.places[i - 1];
      corner[i] = corner[i - 1];
    }
    cell.places[i] = numbers[k];
    corner[i] = static_cast<std::uint8_t>(k);
  }
  for (int k = 0; k < Corners; ++k)
  {
    cell.turn |= std::uint32_t(corner[k]) << 2 * k;
  }
  return cell;
}

/**
 * Sorts the cells of a mesh by their largest place, then by the next ones, then by their place in
 * the file: a cell comes as soon as its last vertex is reached, and cells with the same corners
 * stand side by side.
 */
template <int Corners>
using CellSort = ExternalSort<PlacedCell<Corners>>;

/**
 * Calls `take` with each cell of the mesh, in the file's sequence, by the places that the order
 * gives its vertices, and its element. Vertices of cells must all be in the order.
 */
template <class Take>
void placeCells(
  const RawMesh& mesh, const OrderedVertices& order, Workspace& workspace, Take&& take);

} // namespace smg

#include "IO/Order/PlacedCells.hxx"
