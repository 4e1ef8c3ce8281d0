// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/HashStarClustering.h"

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/Order/Pages/RankedVertices.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

// Neighbourhood of vertices from the graph alone: repeated contraction of stars ("hash stars").
//
// In each round a quarter (tetrahedra: an eighth) of the vertices become centres, by a hash of
// their numbers; each other vertex joins the neighbouring centre with the smallest hash. Cells are
// renumbered by clusters, and those that have collapsed to a point are dropped. Eight rounds make
// clusters of some thousand vertices. Then the vertices are numbered by cluster, from the last
// round back to the first, so that the members of a cluster of any round are consecutive.
//
// Each round is a few passes over its cells, with a table of labels for as many vertices at a time
// as fit into the memory. Hashes, not random numbers, choose the centres: the result depends on the
// mesh alone.

namespace smg
{

namespace
{

using Numbers = RecordFile<std::uint32_t>;

/** Rounds make clusters of some thousand vertices, more than a page has. */
constexpr int Rounds = 8;
constexpr std::int64_t FewVertices = 64;

/** A hash without pattern. It is invertible, hence distinct for distinct vertices, so that minima
 * are unique. */
std::uint32_t hash(std::uint32_t vertex, int round)
{
  std::uint32_t bits = vertex ^ static_cast<std::uint32_t>(round + 1) * 0x9e3779b9u;
  bits = (bits ^ bits >> 16) * 0x7feb352du;
  bits = (bits ^ bits >> 15) * 0x846ca68bu;
  return bits ^ bits >> 16;
}

/** A mesh of clusters. */
struct Level
{
  std::int64_t vertices;
  std::size_t corners;        ///< of a cell
  const Numbers* cells;       ///< the corners
  int round;                  ///< 0: isolated vertices do not count
  std::uint32_t centresBelow; ///< hashes of centres are below
};

/** The clusters of the vertices of a level. */
struct Contracted
{
  explicit Contracted(Workspace& workspace)
    : parents(workspace)
    , cells(workspace)
  {
  }
  Numbers parents; ///< of each vertex of the level
  Numbers cells;   ///< without those that have collapsed to a point
  std::int64_t vertices = 0;
};

/** Joins the corners of a cell; labels[vertex - first] is the vertex that a corner joined. */
void join(const Level& level, std::span<const std::uint32_t> cell, std::uint32_t first,
  std::span<std::uint32_t> labels)
{
  std::array<std::uint32_t, 4> hashes;
  std::size_t best = 0;
  for (std::size_t k = 0; k < cell.size(); ++k)
  {
    // Every corner of the cell may join the corner with the smallest hash, if that is a centre.
    hashes[k] = hash(cell[k], level.round);
    best = hashes[k] < hashes[best] ? k : best;
  }
  for (std::size_t k = 0; k < cell.size(); ++k)
  {
    const std::uint32_t place = cell[k] - first;
    if (place >= labels.size())
    {
      continue;
    }
    std::uint32_t& label = labels[place];
    // The vertex is used, and on its own unless it joins another one.
    if (label == NoIndex)
    {
      label = cell[k];
    }
    // A vertex that is not a centre and has not joined one comes after all centres.
    if (hashes[k] >= level.centresBelow && hashes[best] < level.centresBelow &&
        (label == cell[k] || hashes[best] < hash(label, level.round)))
    {
      label = cell[best];
    }
  }
}

/** The vertex that each vertex of the level joins, a centre or itself. Those that join
 * themselves are the vertices of the next level; `numbers` gets their numbers there, and
 * `found` their count. */
Numbers findLabels(const Level& level, Workspace& workspace, Relabelling& numbers,
  std::int64_t memory, std::int64_t& found)
{
  // Labels of as many vertices at a time as fit; all cells are read for each range.
  const std::int64_t range = std::min(memory / std::int64_t(sizeof(std::uint32_t)), level.vertices);
  Buffer table(workspace.pool(), static_cast<std::size_t>(range) * sizeof(std::uint32_t));
  Numbers result(workspace);
  std::uint32_t next = 0;
  for (std::int64_t first = 0; first < level.vertices; first += range)
  {
    const std::span labels(reinterpret_cast<std::uint32_t*>(table.data()),
      static_cast<std::size_t>(std::min(range, level.vertices - first)));
    std::ranges::fill(labels, NoIndex);
    forEachStretch(*level.cells, level.corners,
      [&](std::span<const std::uint32_t> cells)
      {
        for (std::size_t i = 0; i < cells.size(); i += level.corners)
        {
          join(level, cells.subspan(i, level.corners), static_cast<std::uint32_t>(first), labels);
        }
      });
    auto vertex = static_cast<std::uint32_t>(first);
    for (std::uint32_t& label : labels)
    {
      // A cluster whose cells have all collapsed stays; an isolated vertex of the mesh does not
      // count.
      if (label == NoIndex && level.round > 0)
      {
        label = vertex;
      }
      if (label == vertex)
      {
        numbers.put(vertex, next++);
      }
      ++vertex;
    }
    result.put(labels);
  }
  found = next;
  return result;
}

/** One round: the cluster of each vertex, and the cells of the clusters. */
Contracted contract(const Level& level, Workspace& workspace, std::int64_t memory)
{
  Contracted result(workspace);
  // A label is the number of a vertex of this level. It is replaced by that vertex's number on the
  // next level, and then serves to renumber the cells.
  Relabelling toParents(workspace, level.vertices, memory);
  {
    Relabelling toNumbers(workspace, level.vertices, memory);
    const Numbers labels = findLabels(level, workspace, toNumbers, memory, result.vertices);
    std::uint32_t vertex = 0;
    toNumbers.apply(labels, 1,
      [&](std::span<const std::uint32_t> parent)
      {
        result.parents.put(parent);
        if (parent[0] != NoIndex)
        {
          toParents.put(vertex, parent[0]);
        }
        ++vertex;
      });
    result.parents.close();
  }
  toParents.apply(*level.cells, level.corners,
    [&](std::span<const std::uint32_t> cell)
    {
      if (std::ranges::any_of(cell, [&](std::uint32_t corner) { return corner != cell[0]; }))
      {
        result.cells.put(cell);
      }
    });
  result.cells.close();
  return result;
}

/** Numbers the vertices of a level by the numbers of their clusters, and within a cluster by their
 * own numbers: by sorting pairs of both. */
void numberByCluster(
  const Numbers& clusters, Workspace& workspace, std::int64_t memory, Relabelling& numbers)
{
  ExternalSort<std::uint64_t> sort(workspace, memory);
  std::uint64_t vertex = 0;
  forEachStretch(clusters, 1,
    [&](std::span<const std::uint32_t> stretch)
    {
      for (const std::uint32_t cluster : stretch)
      {
        sort.put(std::uint64_t(cluster) << 32 | vertex++);
      }
    });
  sort.sort();
  std::uint32_t next = 0;
  for (std::uint64_t key; sort.next(key);)
  {
    numbers.put(static_cast<std::uint32_t>(key), next++);
  }
}

} // namespace

RecordFile<std::uint32_t> clusterNumbers(const RawMesh& mesh, Workspace& workspace)
{
  const std::int64_t memory = workspace.available() / 4;
  const bool triangles = mesh.cellType == CellType::Triangle;
  Level level{ mesh.vertices, static_cast<std::size_t>(cornersOf(mesh.cellType)), &mesh.corners, 0,
    std::uint32_t(1) << (triangles ? 30 : 29) };
  std::vector<Numbers> parents;
  std::vector<std::int64_t> vertices;
  Numbers cells(workspace);
  for (; level.round == 0 ||
         (level.round < Rounds && level.vertices > FewVertices && level.cells->size() > 0);
       ++level.round)
  {
    Contracted next = contract(level, workspace, memory);
    parents.push_back(std::move(next.parents));
    vertices.push_back(level.vertices);
    cells = std::move(next.cells);
    level.cells = &cells;
    level.vertices = next.vertices;
  }
  // The clusters of the last round are numbered by the contraction. From these numbers follow those
  // of each earlier round.
  cells = Numbers(workspace);
  while (parents.size() > 1)
  {
    const Numbers clusters = std::move(parents.back());
    parents.pop_back();
    Relabelling numbers(workspace, vertices[parents.size()], memory);
    numberByCluster(clusters, workspace, memory, numbers);
    Numbers numbered(workspace);
    numbers.apply(parents.back(), 1,
      [&numbered](std::span<const std::uint32_t> number) { numbered.put(number); });
    numbered.close();
    parents.back() = std::move(numbered);
  }
  return std::move(parents.back());
}

} // namespace smg
