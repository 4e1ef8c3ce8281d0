// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/NearestSource.h"

#include "Solver/Core/Vector.h"
#include "Solver/Jobs/Distance/ChunkedMesh.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>

// The straight distance from regions of sources, which bounds an approximate march from below, and
// is the distance itself where the line to the nearest source runs through the mesh (March).
//
// A path from a vertex outside of a region ends at a cell that has vertices inside and outside:
// only the facets of such cells count, which a thick region has few of. They are found with the
// chunks of the mesh; then a tree of them (TriangleTree) is asked for each vertex.
//
// Memory: 116 bytes per facet of a part, and 64 bytes per vertex of a chunk. Time: about
// logarithmic in the number of facets for each vertex and part. The result depends on neither.

namespace smg
{

void SourceFacets::add(std::span<const std::int64_t> vertices, const Ring<double>& points,
  const Ring<std::int64_t>* labels)
{
  Facet facet{};
  std::ranges::fill(std::ranges::copy(vertices, facet.vertices.begin()).out, facet.vertices.end(),
    *std::ranges::max_element(vertices));
  std::ranges::sort(facet.vertices);
  for (std::size_t k = 0; k < 3; ++k)
  {
    std::copy_n(points.at(facet.vertices[k]), 3, facet.triangle.points.point[k]);
    facet.triangle.numbers[k] = labels ? *labels->at(facet.vertices[k]) : -1;
  }
  this->Collected.push_back(facet);
  if (this->Collected.size() == MostCollected)
  {
    this->write();
  }
}

void SourceFacets::write()
{
  std::ranges::sort(this->Collected, {}, &Facet::vertices);
  const auto same = std::ranges::unique(this->Collected, {}, &Facet::vertices);
  this->Collected.erase(same.begin(), same.end());
  std::vector<std::array<std::int64_t, 3>> parts;
  for (const auto& [v, triangle] : this->Collected)
  {
    if (v[0] < v[1])
    {
      parts.insert(
        parts.end(), { { v[0], v[0], v[0] }, { v[1], v[1], v[1] }, { v[2], v[2], v[2] } });
    }
    if (v[0] < v[1] && v[1] < v[2])
    {
      parts.insert(
        parts.end(), { { v[0], v[1], v[1] }, { v[0], v[2], v[2] }, { v[1], v[2], v[2] } });
    }
  }
  std::ranges::sort(parts);
  for (const Facet& facet : this->Collected)
  {
    if (!std::ranges::binary_search(parts, facet.vertices))
    {
      this->To.add(facet.triangle);
    }
  }
  this->Collected.clear();
}

std::int64_t SourceFacets::finish()
{
  this->write();
  this->To.finish();
  return this->To.count();
}

namespace
{

/** Lowers what is known of the nearest sources of consecutive vertices. */
void lower(
  const TrianglePart& facets, std::span<const double> positions, std::span<NearestSource> nearest)
{
  std::int64_t guess = -1;
  for (std::size_t v = 0; v < nearest.size(); ++v)
  {
    const double* const point = positions.data() + 3 * v;
    const TriangleTree::Nearest found = facets.tree().nearest(point, nearest[v].distance, guess);
    if (found.triangle >= 0)
    {
      guess = found.triangle;
      const Vector foot = nearestPoint(facets.points()[static_cast<std::size_t>(guess)], point);
      nearest[v] = { foot, found.distance, facets.numberNearest(guess, foot.data()) };
    }
  }
}

} // namespace

void findNearestSources(ChunkedMesh& mesh, BlockStore& facets, std::int64_t count, Workers& threads,
  Progress& progress, Pool& pool)
{
  constexpr int Coordinates = 3;
  const auto longest = static_cast<std::size_t>(std::min(mesh.plan.length, mesh.vertices));
  const Buffer points(pool, longest * Coordinates * sizeof(double));
  const Buffer values(pool, longest * sizeof(NearestSource));
  const std::int64_t length = TrianglePart::lengthFor(count, 0, pool);
  for (std::int64_t first = 0; first < count; first += length)
  {
    const TrianglePart part(facets, first, std::min(length, count - first), pool);
    for (std::int64_t chunk = 0; chunk < mesh.count(); ++chunk)
    {
      progress.poll();
      const std::int64_t vertices = mesh.countOf(chunk);
      const auto positions = points.values<double>(Coordinates * vertices);
      const auto nearest = values.values<NearestSource>(vertices);
      mesh.readPositions(chunk, positions);
      const std::int64_t index = chunk * ChunkedMesh::MeshParts + ChunkedMesh::NearestSources;
      if (first == 0)
      {
        std::ranges::fill(nearest, NearestSource{ {}, mesh.farthest(), -1 });
      }
      else
      {
        mesh.mesh.read(index, std::as_writable_bytes(nearest));
      }
      // Enough vertices in a row for the guesses to pay, enough parts for many threads.
      constexpr std::int64_t RowVertices = 1024;
      runAll(threads, static_cast<int>((vertices + RowVertices - 1) / RowVertices),
        [&](int row)
        {
          const auto begin = static_cast<std::size_t>(row * RowVertices);
          const std::size_t size = std::min<std::size_t>(RowVertices, nearest.size() - begin);
          lower(part, positions.subspan(Coordinates * begin, Coordinates * size),
            nearest.subspan(begin, size));
        });
      mesh.mesh.write(index, std::as_bytes(nearest));
    }
  }
}

} // namespace smg
