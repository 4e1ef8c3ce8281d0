// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/Import/RawMesh.h"
#include "IO/Order/Pages/OrderedVertices.h"

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>

namespace smg
{

/** A cell by the positions of its corners in an order of the vertices, the largest first. `turn`
 * stores the corner of the file for each of them, two bits each. */
template <int Corners>
struct PlacedCell
{
  std::array<std::uint32_t, Corners> places;
  std::uint32_t element; ///< of the file
  std::uint32_t turn;

  bool operator==(const PlacedCell&) const = default;
  auto operator<=>(const PlacedCell& other) const
  {
    // Two numbers at once: cells are sorted, and most differ there.
    const std::uint64_t first = this->firstPlaces(), second = other.firstPlaces();
    if (first != second)
    {
      return first <=> second;
    }
    return std::tie(this->places, this->element, this->turn) <=>
           std::tie(other.places, other.element, other.turn);
  }

  std::uint64_t firstPlaces() const
  {
    return std::uint64_t(this->places[0]) << 32 | this->places[1];
  }

  /** Fills in the positions in the file's order of corners. */
  void inFile(std::array<std::uint32_t, Corners>& result) const
  {
    for (int k = 0; k < Corners; ++k)
    {
      result[this->turn >> 2 * k & 3] = this->places[k];
    }
  }
};

/** The cell with these numbers of its corners, in the order of the file. */
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
 * Sorts the cells of a mesh by their largest position, then by the next ones, then by their index
 * in the file: a cell comes as soon as its last vertex is reached, and cells with the same corners
 * are adjacent.
 */
template <int Corners>
using CellSort = ExternalSort<PlacedCell<Corners>>;

/** Reads the number of the element of each cell. */
class ElementReader
{
public:
  explicit ElementReader(const RawMesh& mesh)
  {
    if (mesh.elements.size() > 0)
    {
      this->Numbers.emplace(mesh.elements);
    }
  }

  /** The element of the next cell. */
  std::uint32_t next()
  {
    std::uint32_t element = this->Cell++;
    if (this->Numbers)
    {
      this->Numbers->next(element);
    }
    return element;
  }

private:
  std::optional<RecordFile<std::uint32_t>::Reader> Numbers;
  std::uint32_t Cell = 0;
};

/** Calls `take` with each cell of the mesh in the order of the file, by the positions of its
 * vertices in the order, and its element. All vertices of cells must be in the order. */
template <class Take>
void placeCells(
  const RawMesh& mesh, const OrderedVertices& order, Workspace& workspace, Take&& take)
{
  // Half of the free memory for the table; the other half for sorting.
  Relabelling places(workspace, mesh.vertices, workspace.available() / 2);
  {
    OrderedVertexReader vertices(order.records, order.doublePositions);
    OrderedVertex<double> vertex;
    for (std::uint32_t place = 0; vertices.next(vertex); ++place)
    {
      places.put(vertex.id, place);
    }
  }
  ElementReader elements(mesh);
  places.apply(mesh.corners, static_cast<std::size_t>(cornersOf(mesh.cellType)),
    [&](std::span<const std::uint32_t> corners) { take(corners, elements.next()); });
}

} // namespace smg
