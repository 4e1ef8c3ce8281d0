// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/TestMeshes.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace smg::testing
{

/** The order of the cells of a stream. */
enum class TestOrder
{
  Keep,        ///< the mesh's own
  BreadthFirst ///< by the largest place of their vertices in a breadth-first search, component
               ///< after component
};

/** A whole mesh stream in memory: compact, as described at StreamInfo, with its columns. */
struct StreamMesh
{
  CellType cellType = CellType::Triangle;
  std::vector<double> positions;
  std::vector<std::int64_t> corners;
  std::vector<std::int64_t> originalIds; ///< index in the test mesh of each stream vertex
  std::vector<Column> vertexColumns;     ///< a tuple per vertex
  std::vector<Column> cellColumns;       ///< a tuple per cell
  MeshGroups groups = {};                ///< which columns of sets may refer to

  std::int64_t vertices() const { return static_cast<std::int64_t>(this->positions.size() / 3); }
  std::int64_t cells() const
  {
    return static_cast<std::int64_t>(this->corners.size() / cornersOf(this->cellType));
  }
};

/** Sorts the cells and numbers the vertices by first use. Unused vertices are omitted. */
StreamMesh toStream(const IndexedTestMesh& mesh, TestOrder order = TestOrder::BreadthFirst);

/** Reads a whole mesh stream; originalIds are the indices in the stream. */
StreamMesh collect(MeshSource& source);

/** A column of T from its values. */
template <class T>
Column makeColumn(const std::string& name, std::span<const T> values, int components = 1)
{
  Column column{ { name, scalarTypeOf<T>(), components }, {} };
  const auto bytes = std::as_bytes(values);
  column.bytes.assign(bytes.begin(), bytes.end());
  return column;
}

} // namespace smg::testing
