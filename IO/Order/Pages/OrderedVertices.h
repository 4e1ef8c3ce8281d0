// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"

#include <cstdint>

namespace smg
{

/** A vertex at its position in an order. */
template <class Real>
struct OrderedVertex
{
  Real position[3];
  std::uint32_t id; ///< number in the raw mesh
  /** The largest position of a vertex that shares a cell with this one; NoIndex if unknown. */
  std::uint32_t reach;
};

/** The vertices of a raw mesh in an order: one record per vertex, at the positions 0, 1, 2 ... */
struct OrderedVertices
{
  explicit OrderedVertices(Workspace& workspace)
    : records(workspace)
  {
  }

  bool doublePositions = true;
  BucketFile records; ///< OrderedVertex<double> or OrderedVertex<float>
  std::int64_t count = 0;
};

/** Reads vertices of either precision sequentially. */
class OrderedVertexReader
{
public:
  OrderedVertexReader(const BucketFile& records, bool doublePositions)
    : Records(records)
    , DoublePositions(doublePositions)
  {
  }

  /** The next vertex; returns false at the end. */
  bool next(OrderedVertex<double>& vertex)
  {
    if (this->DoublePositions)
    {
      return this->Records.get(vertex);
    }
    OrderedVertex<float> single;
    if (!this->Records.get(single))
    {
      return false;
    }
    vertex = { { single.position[0], single.position[1], single.position[2] }, single.id,
      single.reach };
    return true;
  }

private:
  BucketFile::Reader Records;
  bool DoublePositions;
};

/** Counts of a mesh from its ordering. -1: not counted. */
struct MeshCounts
{
  std::int64_t isolatedVertices = 0;
  std::int64_t components = -1;          ///< connected by edges
  std::int64_t boundaryEdges = -1;       ///< of one triangle; -1 for tetrahedra
  std::int64_t nonManifoldEdges = -1;    ///< of more than two triangles; -1 for tetrahedra
  std::int64_t nonManifoldVertices = -1; ///< see VertexStar; -1 for tetrahedra
};

} // namespace smg
