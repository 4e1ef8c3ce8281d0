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

/** The order of the cells relative to that of the vertices. */
enum class CellSequence
{
  Sorted, ///< each as soon as its last vertex is reached
  AsFiled ///< as in the file; vertices must be in the order of their first use
};

/** A cell with flags. */
struct FlaggedCell
{
  std::uint32_t cell; ///< number in the stream
  std::uint32_t flags;
};

/** A facet of a cell that is in a set of groups. */
struct GroupedFacet
{
  std::uint32_t cell;  ///< number in the stream
  std::uint16_t facet; ///< opposite to this corner
  GroupSet set;
  auto operator<=>(const GroupedFacet&) const = default;
};

/** A mesh as a compact stream, in scratch files. */
struct StreamLayout
{
  explicit StreamLayout(Workspace& workspace)
    : vertices(workspace)
    , corners(workspace)
    , elements(workspace)
    , flags(workspace)
    , facetGroups(workspace)
    , blockVertices(workspace)
    , blockFinalized(workspace)
  {
  }

  /** Cells of a block of a mesh with these columns; the last one may have fewer. */
  static std::int64_t blockCells(const RawMesh& mesh);

  std::int64_t vertexCount = 0;
  std::int64_t cellCount = 0;
  /** The vertices in stream order: OrderedVertex records. Their `reach` is not used. */
  BucketFile vertices;
  RecordFile<std::uint32_t> corners;       ///< stream indices, cornersOf(cellType) per cell
  RecordFile<std::uint32_t> elements;      ///< of the file, of each cell
  RecordFile<FlaggedCell> flags;           ///< by ascending cells
  RecordFile<GroupedFacet> facetGroups;    ///< by ascending cells
  RecordFile<std::int64_t> blockVertices;  ///< number of vertices used up to the end of each block
  RecordFile<std::int64_t> blockFinalized; ///< as MeshBlock::finalized

  MeshGroups groups;
  std::int64_t facetsElsewhere = 0; ///< facets of groups that no cell has

  std::int64_t degenerateCells = 0;
  std::int64_t duplicateCells = 0;
  std::int64_t invertedCells = 0; ///< tetrahedra of negative volume
};

/** Assembles the mesh as a stream in an order: cells by their positions, vertices by first use.
 * Vertices that no cell uses are left out. Throws Error; Cancelled. */
StreamLayout assembleStream(
  const RawMesh& mesh, OrderedVertices order, CellSequence sequence, Workspace& workspace);

/** A cell by the positions of its corners in an order of the vertices, in descending order. `turn`
 * has for each of them its corner in the file, two bits each. */
template <int Corners>
struct PlacedCell
{
  std::array<std::uint32_t, Corners> places;
  std::uint32_t element; ///< of the file
  std::uint32_t turn;

  bool operator==(const PlacedCell&) const = default;
  auto operator<=>(const PlacedCell& other) const
  {
    // The two largest positions as one number: most cells differ there, and comparisons are what a
    // sort costs.
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
  // Half of the free memory for the table; the other half is for what `take` does with the cells.
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
