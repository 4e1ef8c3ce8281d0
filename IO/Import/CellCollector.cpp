// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/CellCollector.h"

#include "IO/Container/Columns.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace smg
{

void CellCollector::reserve(std::int64_t triangles, std::int64_t tetrahedra)
{
  this->Triangles.corners.reserve(static_cast<std::size_t>(triangles) * 3);
  this->Tetrahedra.corners.reserve(static_cast<std::size_t>(tetrahedra) * 4);
}

void CellCollector::noteOriginal(Kind& kind, std::int64_t cells)
{
  if (kind.originals.empty())
  {
    kind.originals.resize(static_cast<std::size_t>(kind.elements));
    std::iota(kind.originals.begin(), kind.originals.end(), std::int64_t(0));
  }
  kind.originals.insert(kind.originals.end(), static_cast<std::size_t>(cells), this->Elements);
}

void CellCollector::polygon(std::span<const std::int64_t> corners)
{
  if (corners.size() < 3)
  {
    this->dropped();
    return;
  }
  this->Polygons += corners.size() > 3;
  this->note(this->Triangles, static_cast<std::int64_t>(corners.size()) - 2);
  for (std::size_t i = 2; i < corners.size(); ++i)
  {
    this->Triangles.corners.insert(
      this->Triangles.corners.end(), { corners[0], corners[i - 1], corners[i] });
  }
}

void CellCollector::strip(std::span<const std::int64_t> corners)
{
  std::vector<std::int64_t>& out = this->Triangles.corners;
  const std::size_t before = out.size();
  std::size_t start = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    if (corners[i] < 0)
    {
      start = i + 1;
    }
    else if (i >= start + 2)
    {
      // Every other triangle of a strip is turned, so that all face the same way.
      const bool odd = (i - start) % 2 != 0;
      out.insert(out.end(), { corners[i - (odd ? 1 : 2)], corners[i - (odd ? 2 : 1)], corners[i] });
    }
  }
  const std::int64_t triangles = static_cast<std::int64_t>(out.size() - before) / 3;
  if (triangles == 0)
  {
    this->dropped();
    return;
  }
  this->Polygons += triangles > 1;
  this->note(this->Triangles, triangles);
}

void CellCollector::finish(IndexedMesh& mesh, std::vector<Column> columns)
{
  const bool volume = !this->Tetrahedra.corners.empty();
  Kind& kind = volume ? this->Tetrahedra : this->Triangles;
  mesh.cellType = volume ? CellType::Tetrahedron : CellType::Triangle;
  mesh.droppedCells = this->Elements - kind.elements;
  mesh.triangulatedPolygons = volume ? 0 : this->Polygons;
  mesh.corners = std::move(kind.corners);
  mesh.originalCells = std::move(kind.originals);
  if (mesh.originalCells.empty())
  {
    // Elements after the last cell were dropped: their tuples go too.
    for (Column& column : columns)
    {
      column.resize(static_cast<std::size_t>(mesh.cells()));
    }
  }
  else
  {
    for (Column& column : columns)
    {
      Column kept;
      gatherTuples(column, mesh.originalCells, kept);
      column = std::move(kept);
    }
  }
  mesh.cellColumns = std::move(columns);
}

} // namespace smg
