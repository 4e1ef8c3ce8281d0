// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Assembly/StreamAssembly.h"

#include "IO/Formats/Vsm/VsmFormat.h"
#include "IO/Order/Assembly/CellWindow.h"

#include <array>
#include <span>

// The stream in an order of the vertices: cells sorted by the positions of their corners, vertices
// numbered by their first use in these, and for each block of cells how many vertices are final.
//
// Sorted by the largest position, a cell comes as soon as its last vertex is reached, and cells
// with the same corners follow each other, so duplicates are found by comparing neighbours. When
// the largest position moves on to p, no further cell has a largest position below p: vertices
// whose farthest neighbour is below p are final.
//
// Cost: the corners are replaced by positions (Relabelling), sorted externally, and read once. The
// bytes of the stream depend on the order alone, not on memory or threads.

namespace smg
{

namespace
{

/** Writes cells to the layout, one after another. */
template <int Corners, class Real>
class Assembler
{
public:
  Assembler(
    const RawMesh& mesh, const OrderedVertices& order, StreamLayout& layout, Workspace& workspace)
    : Layout(layout)
    , BlockCells(StreamLayout::blockCells(mesh))
    , Window(order, layout, workspace)
    , Shapes(layout, workspace)
  {
  }

  /** Appends the next cell. `duplicate`: an earlier cell has the same corners. */
  void take(const PlacedCell<Corners>& cell, bool duplicate)
  {
    std::array<std::uint32_t, Corners> corners;
    auto& shape = this->Shapes.add();
    shape.isDuplicate = duplicate;
    std::array<std::uint32_t, Corners> places;
    // In the order of the file: the orientation of the cell must stay, and vertices are numbered in
    // that order.
    cell.inFile(places);
    for (std::size_t k = 0; k < Corners; ++k)
    {
      corners[k] = this->Window.use(places[k], shape.points[k]);
      shape.corners[k] = corners[k];
    }
    this->Layout.corners.put(std::span<const std::uint32_t>(corners));
    this->Layout.elements.put(cell.element);
    if (++this->Layout.cellCount % this->BlockCells == 0)
    {
      this->endBlock();
    }
  }

  void pass(std::uint32_t place) { this->Window.pass(place); }

  void finish()
  {
    if (this->Layout.cellCount % this->BlockCells != 0)
    {
      this->endBlock();
    }
    this->Shapes.finish();
    this->Layout.vertices.close();
    this->Layout.corners.close();
    this->Layout.elements.close();
    this->Layout.flags.close();
    this->Layout.blockVertices.close();
    this->Layout.blockFinalized.close();
  }

private:
  void endBlock()
  {
    this->Layout.blockVertices.put(this->Layout.vertexCount);
    this->Layout.blockFinalized.put(this->Window.finalized());
  }

  StreamLayout& Layout;
  const std::int64_t BlockCells;
  CellWindow<Real> Window;
  CellShapes<Corners> Shapes;
};

/** The cells that have the corners of an earlier cell, by their indices in the file. Cells that
 * stay in the order of the file are sorted for this purpose only. */
template <int Corners>
RecordFile<std::uint32_t> duplicates(const RawMesh& mesh, Workspace& workspace)
{
  const std::int64_t memory = workspace.available() / 3;
  ExternalSort<std::uint32_t> found(workspace, memory);
  {
    CellSort<Corners> cells(workspace, memory);
    RecordFile<std::uint32_t>::Reader corners(mesh.corners);
    std::array<std::uint32_t, Corners> numbers;
    for (std::uint32_t cell = 0; corners.next(numbers); ++cell)
    {
      cells.put(placedCell<Corners>(numbers.data(), cell));
    }
    cells.sort();
    PlacedCell<Corners> before{}, cell{};
    for (bool first = true; cells.next(cell); first = false)
    {
      if (!first && cell.places == before.places)
      {
        // Cells with the same corners come in the order of the file: all but the first are
        // duplicates.
        found.put(cell.element);
      }
      before = cell;
    }
  }
  found.sort();
  RecordFile<std::uint32_t> result(workspace);
  for (std::uint32_t cell = 0; found.next(cell);)
  {
    result.put(cell);
  }
  result.close();
  return result;
}

template <int Corners, class Real>
void assembleSorted(
  const RawMesh& mesh, const OrderedVertices& order, Workspace& workspace, StreamLayout& layout)
{
  // placeCells() takes half of what is left for its table; both are in use at the same time.
  CellSort<Corners> cells(workspace, workspace.available() * 2 / 5);
  placeCells(mesh, order, workspace,
    [&cells](std::span<const std::uint32_t> places, std::uint32_t element)
    { cells.put(placedCell<Corners>(places.data(), element)); });
  cells.sort();
  Assembler<Corners, Real> assembler(mesh, order, layout, workspace);
  PlacedCell<Corners> before{}, cell{};
  for (bool first = true; cells.next(cell); first = false)
  {
    if (!first && cell.places[0] != before.places[0])
    {
      // All cells with a smaller largest position have been written.
      assembler.pass(cell.places[0] - 1);
    }
    assembler.take(cell, !first && cell.places == before.places);
    before = cell;
  }
  assembler.finish();
}

template <int Corners, class Real>
void assembleAsFiled(
  const RawMesh& mesh, const OrderedVertices& order, Workspace& workspace, StreamLayout& layout)
{
  const RecordFile<std::uint32_t> doubles = duplicates<Corners>(mesh, workspace);
  RecordFile<std::uint32_t>::Reader duplicate(doubles);
  std::uint32_t nextDuplicate = NoIndex;
  duplicate.next(nextDuplicate);
  // The positions of the cells come while the table that gives them is in memory. They are stored
  // first, so that this memory is free for the window.
  RecordFile<std::uint32_t> placed(workspace);
  placeCells(mesh, order, workspace,
    [&placed](std::span<const std::uint32_t> places, std::uint32_t) { placed.put(places); });
  placed.close();
  Assembler<Corners, Real> assembler(mesh, order, layout, workspace);
  RecordFile<std::uint32_t>::Reader corners(placed);
  ElementReader elements(mesh);
  std::array<std::uint32_t, Corners> places;
  for (std::uint32_t cell = 0; corners.next(places); ++cell)
  {
    const bool isDuplicate = cell == nextDuplicate;
    if (isDuplicate && !duplicate.next(nextDuplicate))
    {
      nextDuplicate = NoIndex;
    }
    // Without pass(): in the order of a file any later cell may use any vertex, so none is declared
    // final.
    assembler.take(placedCell<Corners>(places.data(), elements.next()), isDuplicate);
  }
  assembler.finish();
}

} // namespace

std::int64_t StreamLayout::blockCells(const RawMesh& mesh)
{
  std::int64_t bytes = 0;
  for (const auto* columns : { &mesh.vertexColumns, &mesh.elementColumns })
  {
    for (const RawColumn& column : *columns)
    {
      bytes += static_cast<std::int64_t>(column.spec.tupleBytes());
    }
  }
  return 2 * VsmFormat::blockRows(bytes);
}

StreamLayout assembleStream(
  const RawMesh& mesh, OrderedVertices order, CellSequence sequence, Workspace& workspace)
{
  StreamLayout layout(workspace);
  const auto assemble = [&]<int Corners, class Real>()
  {
    sequence == CellSequence::Sorted
      ? assembleSorted<Corners, Real>(mesh, order, workspace, layout)
      : assembleAsFiled<Corners, Real>(mesh, order, workspace, layout);
  };
  if (mesh.cellType == CellType::Triangle)
  {
    order.doublePositions ? assemble.template operator()<3, double>()
                          : assemble.template operator()<3, float>();
  }
  else
  {
    order.doublePositions ? assemble.template operator()<4, double>()
                          : assemble.template operator()<4, float>();
  }
  return layout;
}

} // namespace smg
