// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/VertexGroups.h"

#include "IO/External/ExternalSort.h"
#include "IO/Import/GroupTable.h"

#include <compare>
#include <cstdint>
#include <utility>

namespace smg
{
namespace
{

/** A vertex in a set of groups. */
struct GroupedVertex
{
  std::uint32_t vertex;
  std::uint32_t set;
  auto operator<=>(const GroupedVertex&) const = default;
};

} // namespace

void addVertexGroups(RawMesh& mesh, Workspace& workspace)
{
  if (mesh.points.sets.size() == 0)
  {
    return;
  }
  ExternalSort<GroupedVertex> vertices(workspace, workspace.available() / 3);
  {
    RecordFile<std::uint32_t>::Reader corners(mesh.points.corners);
    RecordFile<GroupSet>::Reader sets(mesh.points.sets);
    std::uint32_t vertex = 0;
    for (GroupSet set = 0; corners.next(vertex) && sets.next(set);)
    {
      vertices.put({ vertex, set });
    }
  }
  vertices.sort();
  mesh.points = GroupedElements(workspace);
  GroupSets sets(std::move(mesh.groups.sets));
  RawColumn column{ MeshGroups::columnSpec(GroupOf::Vertices, 1), BucketFile(workspace) };
  GroupedVertex next{};
  bool isAhead = vertices.next(next);
  for (std::int64_t vertex = 0; vertex < mesh.vertices; ++vertex)
  {
    GroupSet all = 0;
    for (; isAhead && next.vertex == vertex; isAhead = vertices.next(next))
    {
      all = sets.join(all, static_cast<GroupSet>(next.set));
    }
    column.tuples.put(0, all);
  }
  column.tuples.close();
  if (sets.overflowed())
  {
    mesh.counts.notes.push_back(GroupSets::overflowNote());
  }
  mesh.groups.sets = sets.all();
  mesh.vertexColumns.push_back(std::move(column));
}

} // namespace smg
