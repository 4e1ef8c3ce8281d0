// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/FirstUseOrder.h"

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/External/RowTable.h"

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

/** The first corner, among all of the file, that a vertex is. */
struct FirstUse
{
  std::uint64_t corner;
  std::uint32_t id;
  auto operator<=>(const FirstUse&) const = default;
};

/** Puts the first use of each used vertex, with a bit for each vertex of a range at a time. */
void putFirstUses(const RawMesh& mesh, Workspace& workspace, ExternalSort<FirstUse>& uses)
{
  const auto words = static_cast<std::size_t>(std::clamp<std::int64_t>(
    workspace.available() / 4 / std::int64_t(sizeof(std::uint64_t)), 1, mesh.vertices / 64 + 1));
  Buffer bytes(workspace.pool(), words * sizeof(std::uint64_t));
  const std::span seen(reinterpret_cast<std::uint64_t*>(bytes.data()), words);
  const std::uint64_t range = 64 * words;
  for (std::uint64_t first = 0; first < static_cast<std::uint64_t>(mesh.vertices); first += range)
  {
    std::ranges::fill(seen, 0);
    RecordFile<std::uint32_t>::Reader corners(mesh.corners);
    std::uint32_t id = 0;
    for (std::uint64_t corner = 0; corners.next(id); ++corner)
    {
      if (id < first || id - first >= range)
      {
        continue;
      }
      std::uint64_t& word = seen[(id - first) / 64];
      const std::uint64_t bit = std::uint64_t(1) << (id - first) % 64;
      if ((word & bit) == 0)
      {
        word |= bit;
        uses.put({ corner, id });
      }
    }
  }
}

/** Gives the vertices to `used` as they come; answers how many. */
std::int64_t findUsed(const RawMesh& mesh, Workspace& workspace, VertexSort& used)
{
  ExternalSort<FirstUse> uses(workspace, workspace.available() / 4);
  putFirstUses(mesh, workspace, uses);
  uses.sort();
  std::uint32_t count = 0;
  for (FirstUse use{}; uses.next(use);)
  {
    used.put({ use.id, count++ });
  }
  return count;
}

template <class Real>
void order(const RawMesh& mesh, Workspace& workspace, OrderedVertices& result)
{
  VertexSort used(workspace, workspace.available() / 3);
  result.count = findUsed(mesh, workspace, used);
  used.sort();
  RowTable rows(workspace, result.count, sizeof(OrderedVertex<Real>), workspace.available() / 4);
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
  rows.close();
  for (std::int64_t first = 0; first < rows.count(); first += rows.range())
  {
    result.records.append(0, rows.read(first));
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
