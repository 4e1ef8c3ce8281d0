// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"
#include "smg/Column.h"
#include "smg/Groups.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** Counts of the changes to a mesh while its file was parsed. */
struct ImportCounts
{
  std::int64_t triangulatedPolygons = 0;      ///< polygons and strips that became several triangles
  std::int64_t splitCells = 0;                ///< hexahedra, wedges, pyramids split into tetrahedra
  std::int64_t higherOrderCells = 0;          ///< cells with points besides their corners
  std::int64_t droppedCells = 0;              ///< points, lines, and cells of the other kind
  std::int64_t mergedPoints = 0;              ///< points that were merged with another one
  std::int64_t timeSteps = 0, partitions = 0; ///< of the file, if any
  /** Names of columns that were omitted because they are reserved. */
  std::vector<std::string> droppedColumns;
  /** Notes for the user. */
  std::vector<std::string> notes;
};

/** An attribute of a raw mesh. */
struct RawColumn
{
  ColumnSpec spec;
  BucketFile tuples; ///< consecutive
};

/** A reader of each column, all of them in `memory` bytes if small buffers are sufficient. */
inline std::vector<BucketFile::Reader> readersOf(
  const std::vector<RawColumn>& columns, std::int64_t memory)
{
  const std::size_t share =
    static_cast<std::size_t>(memory) / std::max<std::size_t>(columns.size(), 1);
  std::vector<BucketFile::Reader> readers;
  readers.reserve(columns.size());
  for (const RawColumn& column : columns)
  {
    readers.emplace_back(
      column.tuples, 0, std::clamp(share, BucketFile::MinChunkBytes, BucketFile::ChunkBytes / 4));
  }
  return readers;
}

/** Elements of a file that are no cells of the mesh, but members of groups. */
struct GroupedElements
{
  explicit GroupedElements(Workspace& workspace)
    : corners(workspace)
    , sets(workspace)
  {
  }

  void close()
  {
    this->corners.close();
    this->sets.close();
  }

  RecordFile<std::uint32_t> corners; ///< of each element as many vertices
  RecordFile<GroupSet> sets;         ///< of the groups of each element
};

/**
 * The mesh of a file, in scratch files: any vertex order, any cell order, isolated vertices.
 * At most 2^32 - 2 vertices, cells and elements.
 *
 * An *element* is a cell of the file of any kind, in the order of the file. It becomes any number
 * of cells of the mesh, which store their element.
 */
struct RawMesh
{
  explicit RawMesh(Workspace& workspace)
    : positions(workspace)
    , corners(workspace)
    , elements(workspace)
    , facets(workspace)
    , points(workspace)
    , links(workspace)
  {
  }

  CellType cellType = CellType::Triangle;
  /** Whether the coordinates had double precision in the file. */
  bool doublePositions = true;
  std::int64_t vertices = 0;
  std::int64_t cells = 0;
  std::int64_t elementCount = 0;

  BucketFile positions;                  ///< x, y, z per vertex: doubles or floats; finite
  RecordFile<std::uint32_t> corners;     ///< cornersOf(cellType) per cell, each below `vertices`
  RecordFile<std::uint32_t> elements;    ///< the element of each cell; empty: cell c is element c
  std::vector<RawColumn> vertexColumns;  ///< a tuple per vertex
  std::vector<RawColumn> elementColumns; ///< a tuple per element; CellGroups is one of them
  MeshGroups groups;
  GroupedElements facets; ///< edges of triangles or faces of tetrahedra, as far as they are such
  GroupedElements points; ///< one vertex each; a vertex may occur several times
  /** Pairs of vertices that are neighbours, as those of cells are, for the order alone. */
  RecordFile<std::uint32_t> links;
  ImportCounts counts;

  std::size_t positionBytes() const
  {
    return 3 * (this->doublePositions ? sizeof(double) : sizeof(float));
  }
};

} // namespace smg
