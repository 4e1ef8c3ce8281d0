// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/MeshFile.h"
#include "IO/Import/RawMesh.h"
#include "smg/Column.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace smg::testing
{

/** A raw mesh in memory. */
struct ReadMesh
{
  CellType cellType = CellType::Triangle;
  bool doublePositions = true;
  std::int64_t elementCount = 0;
  std::vector<double> positions;     ///< x, y, z per vertex
  std::vector<std::int64_t> corners; ///< cornersOf(cellType) per cell
  /** The element of each cell, also if the raw mesh omits them. */
  std::vector<std::int64_t> elements;
  std::vector<Column> vertexColumns, elementColumns;
  MeshGroups groups;
  std::vector<std::int64_t> facets, points; ///< corners of elements that are no cells
  std::vector<GroupSet> facetSets, pointSets;
  ImportCounts counts;

  std::int64_t vertices() const { return static_cast<std::int64_t>(this->positions.size() / 3); }
  std::int64_t cells() const
  {
    return static_cast<std::int64_t>(this->corners.size()) / cornersOf(this->cellType);
  }
};

/** All bytes of a bucket. */
inline std::vector<std::byte> bytesOf(const BucketFile& file, int bucket = 0)
{
  std::vector<std::byte> bytes;
  BucketFile::Reader reader(file, bucket);
  for (auto part = reader.next(1); !part.empty(); part = reader.next(1))
  {
    bytes.insert(bytes.end(), part.begin(), part.end());
  }
  return bytes;
}

/** All values of type T of a bucket, as values of type U. */
template <class T, class U>
std::vector<U> valuesOf(const BucketFile& file)
{
  const std::vector<std::byte> bytes = bytesOf(file);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return { values.begin(), values.end() };
}

inline std::vector<std::int64_t> numbersOf(const RecordFile<std::uint32_t>& file)
{
  std::vector<std::int64_t> numbers;
  RecordFile<std::uint32_t>::Reader reader(file);
  for (std::uint32_t number; reader.next(number);)
  {
    numbers.push_back(number);
  }
  return numbers;
}

inline std::vector<GroupSet> setsOf(const RecordFile<GroupSet>& file)
{
  std::vector<GroupSet> sets;
  RecordFile<GroupSet>::Reader reader(file);
  for (GroupSet set; reader.next(set);)
  {
    sets.push_back(set);
  }
  return sets;
}

inline std::vector<Column> columnsOf(const std::vector<RawColumn>& columns)
{
  std::vector<Column> read;
  for (const RawColumn& column : columns)
  {
    read.push_back({ column.spec, bytesOf(column.tuples) });
  }
  return read;
}

/** Reads a raw mesh, which can be read again afterwards. */
inline ReadMesh readRaw(const RawMesh& mesh)
{
  ReadMesh read;
  read.cellType = mesh.cellType;
  read.doublePositions = mesh.doublePositions;
  read.elementCount = mesh.elementCount;
  read.positions = mesh.doublePositions ? valuesOf<double, double>(mesh.positions)
                                        : valuesOf<float, double>(mesh.positions);
  read.corners = numbersOf(mesh.corners);
  read.elements = numbersOf(mesh.elements);
  if (read.elements.empty())
  {
    read.elements.resize(static_cast<std::size_t>(mesh.cells));
    std::iota(read.elements.begin(), read.elements.end(), 0);
  }
  read.vertexColumns = columnsOf(mesh.vertexColumns);
  read.elementColumns = columnsOf(mesh.elementColumns);
  read.groups = mesh.groups;
  read.facets = numbersOf(mesh.facets.corners);
  read.points = numbersOf(mesh.points.corners);
  read.facetSets = setsOf(mesh.facets.sets);
  read.pointSets = setsOf(mesh.points.sets);
  read.counts = mesh.counts;
  return read;
}

/** The number of members of each group, as "facets inlet". */
using GroupCounts = std::map<std::string, int>;

/** Those of a mesh: elements, facets of the file, and vertices as often as they are named. */
inline GroupCounts groupCounts(const ReadMesh& mesh)
{
  GroupCounts counts;
  const auto count = [&](std::span<const GroupSet> sets, GroupOf kind)
  {
    for (const GroupSet set : sets)
    {
      for (const std::uint32_t index : mesh.groups.sets.at(set))
      {
        const Group& group = mesh.groups.groups.at(index);
        constexpr const char* kinds[] = { "vertices ", "facets ", "cells " };
        counts[kinds[std::size_t(kind)] + group.label()] += group.of == kind ? 1 : 0;
      }
    }
  };
  count(mesh.facetSets, GroupOf::Facets);
  count(mesh.pointSets, GroupOf::Vertices);
  for (const std::vector<Column>* columns : { &mesh.elementColumns, &mesh.vertexColumns })
  {
    for (const Column& column : *columns)
    {
      for (const GroupOf kind : { GroupOf::Vertices, GroupOf::Facets, GroupOf::Cells })
      {
        if (column.spec.name == MeshGroups::columnOf(kind))
        {
          count(column.as<GroupSet>(), kind);
        }
      }
    }
  }
  std::erase_if(counts, [](const auto& group) { return group.second == 0; });
  return counts;
}

/** The column of the elements of this name; throws if there is none. */
inline const Column& elementColumn(const ReadMesh& mesh, const std::string& name)
{
  for (const Column& column : mesh.elementColumns)
  {
    if (column.spec.name == name)
    {
      return column;
    }
  }
  throw std::out_of_range("no column " + name);
}

/** Expects that corners are vertices and that columns have the correct number of tuples. */
inline void expectValid(const ReadMesh& mesh)
{
  for (const std::int64_t corner : mesh.corners)
  {
    ASSERT_LT(corner, mesh.vertices());
  }
  for (const Column& column : mesh.vertexColumns)
  {
    ASSERT_EQ(column.tuples(), static_cast<std::size_t>(mesh.vertices()));
  }
  for (const Column& column : mesh.elementColumns)
  {
    ASSERT_EQ(column.tuples(), static_cast<std::size_t>(mesh.elementCount));
  }
  ASSERT_EQ(static_cast<std::int64_t>(mesh.elements.size()), mesh.cells());
}

/** The mesh of a file in memory. */
inline ReadMesh importWhole(const std::filesystem::path& path, CellChoice cells = CellChoice::Only)
{
  Workspace workspace({}, Workspace::MinMemory);
  return readRaw(importMesh(path, workspace, { cells, {} }));
}

} // namespace smg::testing
