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

  std::size_t recordBytes() const
  {
    return this->doublePositions ? sizeof(OrderedVertex<double>) : sizeof(OrderedVertex<float>);
  }
};

} // namespace smg
