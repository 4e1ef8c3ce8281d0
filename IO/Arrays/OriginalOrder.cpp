// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/OriginalOrder.h"

#include "IO/External/ExternalSort.h"
#include "IO/External/Workspace.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/Vsm/WriteVsm.h"
#include "IO/Import/Weld.h"
#include "Solver/Core/Progress.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace smg
{
namespace
{

/** Numbers of vertices or cells, which may be 0, 1, ... in any order. */
class SeenNumbers
{
public:
  /** Of `count` numbers. */
  explicit SeenNumbers(std::int64_t count)
    : Seen(static_cast<std::size_t>(count))
  {
  }

  void add(std::span<const std::int64_t> numbers)
  {
    for (const std::int64_t number : numbers)
    {
      const auto place = static_cast<std::size_t>(number);
      if (number < 0 || place >= this->Seen.size() || this->Seen[place])
      {
        this->AreRows = false;
        return;
      }
      this->Seen[place] = true;
    }
  }
  bool areRows() const { return this->AreRows; }

private:
  std::vector<bool> Seen;
  bool AreRows = true;
};

bool hasNumbers(const StoredMesh& mesh)
{
  return findColumn(mesh.info().vertexColumns, OriginalIdSpec) >= 0;
}

/** The places of these numbers in ascending order, equal ones in their own order. */
std::vector<std::int64_t> ranksOf(const std::vector<std::int64_t>& numbers)
{
  std::vector<std::int64_t> order(numbers.size()), ranks(numbers.size());
  std::iota(order.begin(), order.end(), std::int64_t(0));
  std::ranges::stable_sort(order, {}, [&numbers](std::int64_t index) { return numbers[index]; });
  for (std::size_t rank = 0; rank < order.size(); ++rank)
  {
    ranks[static_cast<std::size_t>(order[rank])] = static_cast<std::int64_t>(rank);
  }
  return ranks;
}

bool hasCellNumbers(const StoredMesh& mesh)
{
  return findColumn(mesh.info().cellColumns, OriginalCellIdSpec) >= 0;
}

/** Whether each element of the file has become a cell of the mesh: one of a lower dimension is not,
 * but in a group of facets or vertices. */
bool keepsCells(const StoredMesh& mesh, const ConversionReport& conversion)
{
  return !conversion.keeps_numbers && conversion.dropped_cells == 0 &&
         conversion.triangulated_polygons == 0 && conversion.split_cells == 0 &&
         std::ranges::all_of(mesh.info().groups.groups,
           [](const Group& group) { return group.of == GroupOf::Cells; });
}

} // namespace

std::int64_t countElements(
  const StoredMesh& mesh, const ConversionReport* conversion, const ProgressFunction& progress)
{
  // What was left out, or is in groups of facets, has numbers that no cell has.
  const bool areWhole = conversion && !conversion->keeps_numbers &&
                        conversion->triangulated_polygons == 0 && conversion->split_cells == 0;
  if (areWhole || !hasCellNumbers(mesh))
  {
    return mesh.info().cells;
  }
  constexpr std::int64_t Memory = std::int64_t(64) << 20;
  Workspace workspace({}, Memory);
  ExternalSort<std::int64_t> numbers(workspace, Memory / 2);
  visitBlocks(*mesh.source({}, { OriginalCellIdName }), progress, 0.0, 1.0,
    [&numbers](const MeshBlock& block)
    {
      for (const std::int64_t number : block.cellColumns[0].as<std::int64_t>())
      {
        numbers.put(number);
      }
    });
  numbers.sort();
  std::int64_t count = 0;
  for (std::int64_t last = 0, next = 0; numbers.next(next); last = next)
  {
    count += count == 0 || next != last ? 1 : 0;
  }
  return count;
}

OriginalOrder::OriginalOrder(const StoredMesh& mesh, const ConversionReport* conversion,
  const ProgressFunction& progress, std::optional<double> weld)
  : StreamVertices(mesh.info().vertices)
{
  this->Vertices.count = countVertices(mesh);
  this->Cells.count = mesh.info().cells;
  const bool isTold = conversion && !conversion->keeps_numbers;
  if (isTold && hasNumbers(mesh))
  {
    this->Vertices.column = OriginalIdName;
  }
  else
  {
    this->readVertices(mesh, partOf(progress, 0.0, 0.5));
  }
  if (isTold && keepsCells(mesh, *conversion) && hasCellNumbers(mesh))
  {
    this->Cells.column = OriginalCellIdName;
  }
  else
  {
    this->readCells(mesh, partOf(progress, 0.5, 1.0));
  }
  // A point that was merged is a vertex of no cell.
  const bool mayMerge = this->Vertices.count > this->StreamVertices;
  if (weld && mayMerge && (!conversion || conversion->merged_points > 0))
  {
    this->findMerged(mesh, *weld, partOf(progress, 1.0, 1.0));
  }
}

std::int64_t OriginalOrder::countVertices(const StoredMesh& mesh)
{
  return mesh.info().vertices +
         VsmReader(mesh.file(), nullptr, mesh.fileFingerprint()).isolatedVertices();
}

void OriginalOrder::readVertices(const StoredMesh& mesh, const ProgressFunction& progress)
{
  if (!hasNumbers(mesh))
  {
    return;
  }
  SeenNumbers seen(this->Vertices.count);
  visitBlocks(*mesh.source({ OriginalIdName }, {}), progress, 0.0, 1.0,
    [&seen](const MeshBlock& block) { seen.add(block.vertexColumns[0].as<std::int64_t>()); });
  forEachIsolated(mesh.file(), mesh.fileFingerprint(),
    [&seen](std::int64_t, const IsolatedVertices& vertices) { seen.add(vertices.ids); });
  if (seen.areRows())
  {
    this->Vertices.column = OriginalIdName;
  }
}

void OriginalOrder::readCells(const StoredMesh& mesh, const ProgressFunction& progress)
{
  if (!hasCellNumbers(mesh))
  {
    return;
  }
  std::vector<std::int64_t> numbers;
  numbers.reserve(static_cast<std::size_t>(this->Cells.count));
  visitBlocks(*mesh.source({}, { OriginalCellIdName }), progress, 0.0, 1.0,
    [&numbers](const MeshBlock& block)
    {
      const auto own = block.cellColumns[0].as<std::int64_t>();
      numbers.insert(numbers.end(), own.begin(), own.end());
    });
  SeenNumbers seen(this->Cells.count);
  seen.add(numbers);
  if (seen.areRows())
  {
    this->Cells.column = OriginalCellIdName;
  }
  else if (!std::ranges::is_sorted(numbers))
  {
    this->Cells.table = ranksOf(numbers);
  }
}

/** Merged points are vertices of no cell of the file of the mesh: which ones, and with what,
 * follows from the positions as in the conversion. */
void OriginalOrder::findMerged(
  const StoredMesh& mesh, double weld, const ProgressFunction& progress)
{
  const auto count = static_cast<std::size_t>(this->Vertices.count);
  std::vector<WeldPoint> points(count);
  std::vector<bool> isOfCell(count);
  const auto add = [&points](std::int64_t row, const double* position)
  {
    points[static_cast<std::size_t>(row)] = { { position[0], position[1], position[2] },
      static_cast<std::uint32_t>(row) };
  };
  std::vector<std::int64_t> rows;
  visitBlocks(*mesh.source(this->Vertices.columns(), {}), progress, 0.0, 1.0,
    [&](const MeshBlock& block)
    {
      rows.clear();
      this->Vertices.append(block, rows);
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        add(rows[i], block.positions.data() + 3 * i);
        isOfCell[static_cast<std::size_t>(rows[i])] = true;
      }
    });
  forEachIsolated(mesh.file(), mesh.fileFingerprint(),
    [&](std::int64_t first, const IsolatedVertices& vertices)
    {
      for (std::size_t i = 0; i < vertices.ids.size(); ++i)
      {
        add(this->isolatedRow(first + static_cast<std::int64_t>(i), vertices.ids[i]),
          vertices.positions.data() + 3 * i);
      }
    });
  Progress polled(progress);
  const std::vector<std::uint32_t> kept = mergedWith(
    std::move(points), weld, ConversionOptions::DefaultMemory, [&polled] { polled.update(0.0); });
  for (std::size_t row = 0; row < count; ++row)
  {
    if (!isOfCell[row] && isOfCell[kept[row]])
    {
      this->Merged.push_back({ static_cast<std::int64_t>(row), kept[row] });
    }
  }
}

} // namespace smg
