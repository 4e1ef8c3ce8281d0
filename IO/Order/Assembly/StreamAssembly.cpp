// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Assembly/StreamAssembly.h"

#include "IO/Order/Assembly/CellWindow.h"

#include <array>
#include <span>

namespace smg
{

namespace
{

/** Writes consecutive cells to the layout. */
template <int Corners, class Real>
class Assembler
{
public:
  Assembler(const OrderedVertices& order, StreamLayout& layout, Workspace& workspace)
    : Layout(layout)
    , Window(order, layout, workspace)
    , Shapes(layout, workspace)
  {
  }

  /** Appends the next cell; `duplicate`: whether an earlier one has the same corners. */
  void take(const PlacedCell<Corners>& cell, bool duplicate)
  {
    std::array<std::uint32_t, Corners> corners;
    auto& shape = this->Shapes.add();
    shape.isDuplicate = duplicate;
    std::array<std::uint32_t, Corners> places;
    cell.inFile(places);
    for (std::size_t k = 0; k < Corners; ++k)
    {
      corners[k] = this->Window.use(places[k], shape.points[k]);
      shape.corners[k] = corners[k];
    }
    this->Layout.corners.put(std::span<const std::uint32_t>(corners));
    this->Layout.elements.put(cell.element);
    if (++this->Layout.cellCount % StreamLayout::BlockCells == 0)
    {
      this->endBlock();
    }
  }

  void pass(std::uint32_t place) { this->Window.pass(place); }

  void finish()
  {
    if (this->Layout.cellCount % StreamLayout::BlockCells != 0)
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
  CellWindow<Real> Window;
  CellShapes<Corners> Shapes;
};

/** The cells, by their indices in the file, with the corners of an earlier one. */
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
  CellSort<Corners> cells(workspace, workspace.available() * 2 / 5);
  placeCells(mesh, order, workspace,
    [&cells](std::span<const std::uint32_t> places, std::uint32_t element)
    { cells.put(placedCell<Corners>(places.data(), element)); });
  cells.sort();
  Assembler<Corners, Real> assembler(order, layout, workspace);
  PlacedCell<Corners> before{}, cell{};
  for (bool first = true; cells.next(cell); first = false)
  {
    if (!first && cell.places[0] != before.places[0])
    {
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
  // The positions of the cells come in chunks while their table is in memory.
  RecordFile<std::uint32_t> placed(workspace);
  placeCells(mesh, order, workspace,
    [&placed](std::span<const std::uint32_t> places, std::uint32_t) { placed.put(places); });
  placed.close();
  Assembler<Corners, Real> assembler(order, layout, workspace);
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
    assembler.take(placedCell<Corners>(places.data(), elements.next()), isDuplicate);
  }
  assembler.finish();
}

} // namespace

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
