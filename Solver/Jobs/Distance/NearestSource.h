// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Core/Workers.h"
#include "Solver/Jobs/Distance/TriangleFile.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Memory/Ring.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

struct ChunkedMesh;

/** The point of all sources that is nearest to a vertex on a straight line, whether this runs
 * through the mesh or not: no path is shorter. */
struct NearestSource
{
  std::array<double, 3> point{};
  double distance = 0;
  std::int64_t source = -1; ///< its label, if labels are wanted
};

/** Collects the facets of sources at which paths from other vertices end: faces, edges and vertices
 * of a mesh, each once where they follow each other closely in the stream. */
class SourceFacets
{
public:
  explicit SourceFacets(BlockStore& to)
    : To(to)
  {
    this->Collected.reserve(MostCollected);
  }

  /** Adds the facet of these 1 to 3 vertices; `labels` are those of their sources, or null. */
  void add(std::span<const std::int64_t> vertices, const Ring<double>& points,
    const Ring<std::int64_t>* labels);
  /** To be called after the last facet; returns their number. */
  std::int64_t finish();

private:
  static constexpr std::size_t MostCollected = 1 << 12;

  /** Its vertices in ascending order; the last one is repeated where there are fewer. */
  struct Facet
  {
    std::array<std::int64_t, 3> vertices;
    NumberedTriangle triangle;
  };
  /** Writes what is collected, without what is part of other facets. */
  void write();

  TriangleWriter To;
  std::vector<Facet> Collected;
};

/** Finds the nearest source of each vertex of a mesh, and stores it with the mesh; farther than
 * ChunkedMesh::farthest(), that is all that is known. The facets are in memory, as many at once as
 * its limit allows. */
void findNearestSources(ChunkedMesh& mesh, BlockStore& facets, std::int64_t count, Workers& threads,
  Progress& progress, Pool& pool);

} // namespace smg
