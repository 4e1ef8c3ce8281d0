// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/FirstUseOrder.h"

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/External/RowScatter.h"

#include <algorithm>
#include <array>
#include <vector>

namespace smg
{

namespace
{

/** A vertex, and its place by first use. */
struct UsedVertex
{
  std::uint32_t id;
  std::uint32_t place;
  auto operator<=>(const UsedVertex&) const = default;
};

using VertexSort = ExternalSort<UsedVertex>;

/** Gives the vertices to `used` as they come; answers how many. */
std::int64_t findUsed(const RawMesh& mesh, Workspace& workspace, VertexSort& used)
{
  const auto words = static_cast<std::size_t>(mesh.vertices / 64 + 1);
  Buffer bytes(workspace.pool(), words * sizeof(std::uint64_t));
  const std::span seen(reinterpret_cast<std::uint64_t*>(bytes.data()), words);
  std::fill(seen.begin(), seen.end(), 0);
  std::uint32_t count = 0;
  RecordFile<std::uint32_t>::Reader corners(mesh.corners);
  for (std::uint32_t id = 0; corners.next(id);)
  {
    std::uint64_t& word = seen[id / 64];
    const std::uint64_t bit = std::uint64_t(1) << id % 64;
    if ((word & bit) == 0)
    {
      word |= bit;
      used.put({ id, count++ });
    }
  }
  return count;
}

template <class Real>
void order(const RawMesh& mesh, Workspace& workspace, OrderedVertices& result)
{
  VertexSort used(workspace, workspace.available() / 3);
  result.count = findUsed(mesh, workspace, used);
  used.sort();
  RowScatter rows(workspace, result.count, sizeof(OrderedVertex<Real>), workspace.available() / 3);
  BucketFile::Reader positions(mesh.positions);
  OrderedVertex<Real> vertex{ {}, 0, NoIndex };
  std::int64_t read = -1; // the vertex whose position has been read
  for (UsedVertex next{}; used.next(next);)
  {
    for (; read < next.id; ++read)
    {
      positions.get(vertex.position);
    }
    vertex.id = next.id;
    rows.put(next.place, std::as_bytes(std::span(&vertex, 1)));
  }
  constexpr std::int64_t Rows = 4096;
  for (auto bytes = rows.next(Rows); !bytes.empty(); bytes = rows.next(Rows))
  {
    result.records.append(0, bytes);
  }
}

} // namespace

OrderedVertices firstUseOrder(const RawMesh& mesh, Workspace& workspace)
{
  OrderedVertices result(workspace);
  result.doublePositions = mesh.doublePositions;
  mesh.doublePositions ? order<double>(mesh, workspace, result)
                       : order<float>(mesh, workspace, result);
  result.records.close();
  return result;
}

} // namespace smg
