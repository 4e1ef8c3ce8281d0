// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/PlacedCells.h"

namespace smg
{

namespace
{

template <class Real>
void put(const OrderedVertices& order, Relabelling& places)
{
  BucketFile::Reader records(order.records);
  OrderedVertex<Real> vertex;
  for (std::uint32_t place = 0; records.get(vertex); ++place)
  {
    places.put(vertex.id, place);
  }
}

} // namespace

void putPlaces(const OrderedVertices& order, Relabelling& places)
{
  order.doublePositions ? put<double>(order, places) : put<float>(order, places);
}

} // namespace smg
