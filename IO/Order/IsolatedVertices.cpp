// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/IsolatedVertices.h"

#include "IO/Order/OrderedVertices.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace smg
{

namespace
{

constexpr std::size_t ChunkVertices = 4096;

template <class Real>
void markUsed(const StreamLayout& layout, std::span<std::uint64_t> used)
{
  BucketFile::Reader vertices(layout.vertices);
  for (OrderedVertex<Real> vertex; vertices.get(vertex);)
  {
    used[vertex.id / 64] |= std::uint64_t(1) << vertex.id % 64;
  }
}

template <class Real>
void takeUnused(const RawMesh& mesh, std::span<const std::uint64_t> used, const TakeVertices& take)
{
  std::vector<std::int64_t> ids;
  std::vector<double> positions;
  BucketFile::Reader reader(mesh.positions);
  std::array<Real, 3> position;
  for (std::int64_t id = 0; reader.get(position); ++id)
  {
    if ((used[static_cast<std::size_t>(id / 64)] >> id % 64 & 1) == 0)
    {
      ids.push_back(id);
      positions.insert(positions.end(), position.begin(), position.end());
      if (ids.size() == ChunkVertices)
      {
        take(ids, positions);
        ids.clear();
        positions.clear();
      }
    }
  }
  if (!ids.empty())
  {
    take(ids, positions);
  }
}

} // namespace

void takeIsolatedVertices(
  const RawMesh& mesh, const StreamLayout& layout, Workspace& workspace, const TakeVertices& take)
{
  if (layout.vertexCount == mesh.vertices)
  {
    return;
  }
  const auto words = static_cast<std::size_t>(mesh.vertices / 64 + 1);
  const Buffer bytes(workspace.pool(), words * sizeof(std::uint64_t));
  const std::span used(reinterpret_cast<std::uint64_t*>(bytes.data()), words);
  std::fill(used.begin(), used.end(), 0);
  if (mesh.doublePositions)
  {
    markUsed<double>(layout, used);
    takeUnused<double>(mesh, used, take);
  }
  else
  {
    markUsed<float>(layout, used);
    takeUnused<float>(mesh, used, take);
  }
}

} // namespace smg
