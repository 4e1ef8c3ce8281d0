// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/OriginalOrder.h"

#include "IO/Files/PartialProgress.h"
#include "IO/Formats/Vsm/VsmFormat.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <numeric>
#include <span>

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

} // namespace

OriginalOrder::OriginalOrder(
  const StoredMesh& mesh, const ConversionReport* conversion, const ProgressFunction& progress)
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
  if (isTold && conversion->dropped_cells == 0 && conversion->triangulated_polygons == 0 &&
      conversion->split_cells == 0 && findColumn(mesh.info().cellColumns, OriginalCellIdSpec) >= 0)
  {
    this->Cells.column = OriginalCellIdName;
  }
  else
  {
    this->readCells(mesh, partOf(progress, 0.5, 1.0));
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
  VsmReader reader(mesh.file(), nullptr, mesh.fileFingerprint());
  IsolatedVertices chunk;
  const std::int64_t rows = VsmFormat::blockRows(rowBytes(reader.info().vertexColumns));
  for (std::int64_t first = 0; first < reader.isolatedVertices(); first += rows)
  {
    reader.readIsolated(first, std::min(rows, reader.isolatedVertices() - first), chunk);
    seen.add(chunk.ids);
  }
  if (seen.areRows())
  {
    this->Vertices.column = OriginalIdName;
  }
}

void OriginalOrder::readCells(const StoredMesh& mesh, const ProgressFunction& progress)
{
  if (findColumn(mesh.info().cellColumns, OriginalCellIdSpec) < 0)
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

} // namespace smg
