// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/FirstUseOrder.h"

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <vector>

// The order `keep`: vertices numbered by the first cell of the file that uses them. The first uses
// of all vertices are found with a bit per vertex (a pass over the cells for each range of vertices
// whose bits fit), sorted by their place in the file, and the places joined with the coordinates
// through two row tables.

namespace smg
{

namespace
{

/** The place of the first corner in the file that is a given vertex; all corners count, cell by
 * cell. */
struct FirstUse
{
  std::uint64_t corner;
  std::uint32_t id;
  auto operator<=>(const FirstUse&) const = default;
};

/** Stores the first use of each vertex that a cell uses, with a bit per vertex for one range of
 * vertices at a time. */
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
      // Vertices of other ranges are for other passes.
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

/** Stores the position of each used vertex; returns their number. */
std::int64_t putPlaces(const RawMesh& mesh, Workspace& workspace, RowTable& places)
{
  ExternalSort<FirstUse> uses(workspace, workspace.available() / 3);
  putFirstUses(mesh, workspace, uses);
  uses.sort();
  std::uint32_t count = 0;
  for (FirstUse use{}; uses.next(use); ++count)
  {
    // Sorted by corner, the uses come in the order of the positions.
    places.put(use.id, std::as_bytes(std::span(&count, 1)));
  }
  places.close();
  return count;
}

template <class Real>
void order(const RawMesh& mesh, Workspace& workspace, OrderedVertices& result)
{
  RowTable places(workspace, mesh.vertices, sizeof(std::uint32_t), workspace.available() / 4);
  result.count = putPlaces(mesh, workspace, places);
  RowTable rows(workspace, result.count, sizeof(OrderedVertex<Real>), workspace.available() / 4);
  OrderedVertex<Real> vertex{ {}, 0, NoIndex };
  BucketFile::Reader positions(mesh.positions);
  for (std::span<const std::byte> bytes; positions.get(vertex.position); ++vertex.id)
  {
    if (bytes.empty())
    {
      bytes = places.read(vertex.id);
    }
    std::uint32_t place = 0;
    std::memcpy(&place, bytes.data(), sizeof(place));
    bytes = bytes.subspan(sizeof(place));
    // Isolated vertices have no place: their row has all bits set.
    if (place != NoIndex)
    {
      rows.put(place, std::as_bytes(std::span(&vertex, 1)));
    }
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
