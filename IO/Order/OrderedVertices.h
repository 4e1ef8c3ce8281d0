// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"

#include <cstdint>

namespace smg
{

/** A vertex at its place in an order. */
template <class Real>
struct OrderedVertex
{
  Real position[3];
  std::uint32_t id; ///< number in the raw mesh
  /** The largest place of a vertex that has a cell with this one; NoIndex if that is not known. */
  std::uint32_t reach;
};

/** The vertices of a raw mesh in an order: a record a vertex, by place, 0, 1, 2 ... */
struct OrderedVertices
{
  explicit OrderedVertices(Workspace& workspace)
    : records(workspace)
  {
  }

  bool doublePositions = true;
  BucketFile records; ///< OrderedVertex<double>, or else OrderedVertex<float>
  std::int64_t count = 0;
};

/** Reads vertices of either precision one after the other. */
class OrderedVertexReader
{
public:
  OrderedVertexReader(const BucketFile& records, bool doublePositions)
    : Records(records)
    , DoublePositions(doublePositions)
  {
  }

  /** The next vertex; false at the end. */
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

} // namespace smg
