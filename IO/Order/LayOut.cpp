// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/LayOut.h"

#include "IO/Order/Assembly/FacetGroups.h"
#include "IO/Order/Search/AxisOrder.h"
#include "IO/Order/Search/FileOrder.h"
#include "IO/Order/Search/SpectralOrder.h"
#include "smg/Convert.h"
#include "smg/Error.h"

#include <optional>
#include <utility>

// From a mesh in the order of its file to a stream, in three parts: vertices in pages along a curve
// (Pages), an order of the vertices (Search), the cells in that order (Assembly). The workspace
// bounds the memory, whatever the size of the mesh; the files of a part are removed when it has
// been used. docs/convert.md says what the orders are for, and what a conversion costs.

namespace smg
{

namespace
{

/** Measured bytes of traffic per vertex and per corner, by which the progress of a part is
 * judged. */
constexpr std::int64_t PagesBytes[] = { 90, 20 };
constexpr std::int64_t SearchBytes[] = { 120, 20 };
constexpr std::int64_t AssemblyBytes[] = { 90, 32 };

std::int64_t bytesFor(const RawMesh& mesh, const std::int64_t (&bytes)[2])
{
  return mesh.vertices * bytes[0] + mesh.corners.size() * bytes[1];
}

/** Orders paged vertices, and completes the counts: the search counts the components as it goes,
 * the other orders need a search of their own for that. */
OrderedVertices orderPages(
  PagedMesh& paged, StreamOrder order, Workspace& workspace, LayOutCounts& counts)
{
  if (order == StreamOrder::BreadthFirst)
  {
    OrderedVertices result = breadthFirstOrder(paged, workspace, {}, &counts.pages);
    counts.mesh = paged.counts;
    return result;
  }
  counts.mesh = paged.counts;
  counts.mesh.components = countComponents(paged, workspace);
  return order == StreamOrder::Axis ? axisOrder(paged.pages, workspace)
                                    : spectralOrder(paged, workspace, &counts.notes);
}

} // namespace

StreamLayout layOut(const RawMesh& mesh, StreamOrder order, Workspace& workspace,
  LayOutCounts& counts, double progressEnd)
{
  const double begin = workspace.partEnd();
  const auto part = [&](double done) { return begin + (progressEnd - begin) * done; };
  workspace.beginPart(part(0.4), bytesFor(mesh, PagesBytes));
  // The pages are released before the cells are sorted: they would take room on the disk.
  std::optional<OrderedVertices> vertices;
  {
    PagedMesh paged = buildPages(mesh, workspace);
    workspace.beginPart(part(0.7), bytesFor(mesh, SearchBytes));
    // The order of the file needs no pages. They are made for the counts of components and of edges
    // on the boundary.
    if (order == StreamOrder::Keep)
    {
      counts.mesh = paged.counts;
      counts.mesh.components = countComponents(paged, workspace);
    }
    else
    {
      vertices.emplace(orderPages(paged, order, workspace, counts));
    }
  }
  const bool keep = order == StreamOrder::Keep;
  // From the file alone, without the pages.
  if (keep)
  {
    vertices.emplace(firstUseOrder(mesh, workspace));
  }
  workspace.beginPart(progressEnd, bytesFor(mesh, AssemblyBytes));
  StreamLayout layout = assembleStream(
    mesh, std::move(*vertices), keep ? CellSequence::AsFiled : CellSequence::Sorted, workspace);
  findFacetGroups(mesh, layout, workspace);
  return layout;
}

StreamOrder streamOrder(std::string_view name)
{
  for (const StreamOrder order :
    { StreamOrder::BreadthFirst, StreamOrder::Axis, StreamOrder::Keep, StreamOrder::Spectral })
  {
    if (name == nameOf(order))
    {
      return order;
    }
  }
  throw Error("There is no order '" + std::string(name) + "': choose bfs, spectral, axis or keep.");
}

std::string_view nameOf(StreamOrder order)
{
  constexpr std::string_view names[] = { "bfs", "axis", "keep", "spectral" };
  return names[static_cast<int>(order)];
}

} // namespace smg
