// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/MemorySource.h"
#include "smg/Error.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{

/** A StreamMesh that can be read any number of times, in blocks of a given number of cells. */
class MemoryMesh : public StoredMesh
{
public:
  explicit MemoryMesh(StreamMesh mesh, std::int64_t blockCells = 1000)
    : Mesh(std::move(mesh))
    , BlockCells(blockCells)
    , Info(MemorySource(this->Mesh).info())
  {
  }

  const StreamInfo& info() const override { return this->Info; }
  StreamInfo& info() { return this->Info; }

  std::unique_ptr<MeshSource> source(
    std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const override
  {
    ++this->Readings;
    StreamMesh part = this->Mesh;
    part.vertexColumns = chosen(this->Mesh.vertexColumns, vertexColumns);
    if (hasColumn(this->Mesh.cellColumns, CellFlagsName) &&
        std::ranges::find(cellColumns, CellFlagsName) == cellColumns.end())
    {
      cellColumns.emplace_back(CellFlagsName);
    }
    part.cellColumns = chosen(this->Mesh.cellColumns, cellColumns);
    return std::make_unique<MemorySource>(std::move(part), this->BlockCells);
  }

  const StreamMesh& mesh() const { return this->Mesh; }
  /** How often the mesh was read. */
  int readings() const { return this->Readings; }

private:
  static bool hasColumn(const std::vector<Column>& columns, const std::string& name)
  {
    return std::ranges::any_of(columns, [&](const Column& c) { return c.spec.name == name; });
  }

  static std::vector<Column> chosen(
    const std::vector<Column>& columns, const std::vector<std::string>& names)
  {
    std::vector<Column> result;
    for (const std::string& name : names)
    {
      const auto found =
        std::ranges::find_if(columns, [&](const Column& c) { return c.spec.name == name; });
      if (found == columns.end())
      {
        throw Error("there is no column " + name);
      }
      result.push_back(*found);
    }
    return result;
  }

  StreamMesh Mesh;
  std::int64_t BlockCells;
  StreamInfo Info;
  mutable int Readings = 0;
};

} // namespace smg::testing
