// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/DisjointSets.h"
#include "Testing/IO/BodyOfVertices.h"
#include "Testing/IO/SimplifyFixture.h"
#include "Testing/Support/Isosurface.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

// The law of noisy surfaces: whatever handles, bumps and bodies noise has made, the simplified
// surface has the vertices that were asked for, is manifold and wound as the mesh is, and nothing
// of it has come apart.

namespace smg::testing
{
namespace
{

using Corners = std::vector<std::int64_t>;

/** The edges that are not of one triangle, or of two that run along it in both directions. */
std::int64_t wrongEdges(const Corners& corners)
{
  std::map<std::pair<std::int64_t, std::int64_t>, std::array<int, 2>> edges;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const std::int64_t a = corners[i], b = corners[i % 3 == 2 ? i - 2 : i + 1];
    ++edges[std::minmax(a, b)][a < b ? 0 : 1];
  }
  return std::ranges::count_if(
    edges, [](const auto& edge) { return edge.second[0] > 1 || edge.second[1] > 1; });
}

/** The vertices whose triangles are more than one fan. */
std::int64_t wrongVertices(const Corners& corners)
{
  // Each triangle is three places, one at each corner; those at a vertex are joined along edges.
  DisjointSets<std::int64_t> places(corners.size());
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> first;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    for (const std::size_t k : { i % 3 == 2 ? i - 2 : i + 1, i % 3 == 0 ? i + 2 : i - 1 })
    {
      const auto at = first.try_emplace({ corners[i], corners[k] }, static_cast<std::int64_t>(i));
      places.join(at.first->second, static_cast<std::int64_t>(i));
    }
  }
  std::map<std::int64_t, std::set<std::int64_t>> fans;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    fans[corners[i]].insert(places.first(static_cast<std::int64_t>(i)));
  }
  return std::ranges::count_if(fans, [](const auto& of) { return of.second.size() > 1; });
}

/** The pairs of a body of the mesh and one of the simplified mesh that have a vertex in common. */
std::set<std::pair<std::int64_t, std::int64_t>> commonBodies(
  const StreamMesh& mesh, const StreamMesh& simple)
{
  const std::vector<std::int64_t> before = bodyOfVertices(mesh);
  const std::vector<std::int64_t> after = bodyOfVertices(simple);
  std::set<std::pair<std::int64_t, std::int64_t>> pairs;
  for (std::size_t v = 0; v < after.size(); ++v)
  {
    pairs.emplace(before[static_cast<std::size_t>(simple.vertexColumns.back().value(v))], after[v]);
  }
  return pairs;
}

} // namespace

using SimplifyLaw = SimplifyFixture;

TEST_F(SimplifyLaw, NoisySurfacesAreManifoldAndInOnePiece)
{
  for (const double noise : { 0.1, 0.4, 1.0 })
  {
    const StreamMesh mesh = toStream(noisyGyroid(32, noise));
    ASSERT_EQ(wrongEdges(mesh.corners), 0);
    for (const std::int64_t memory : { 256, 16 })
    {
      for (const std::int64_t vertices : { 400, 1000, 4000 })
      {
        SCOPED_TRACE("noise " + std::to_string(noise) + ", to " + std::to_string(vertices) +
                     " in " + std::to_string(memory) + " MiB");
        const StreamMesh simple = this->simplified(mesh, { .vertices = vertices }, memory);
        const SimplifyReport& report = this->Report;
        EXPECT_LE(report.vertices, vertices);
        EXPECT_GE(report.vertices, vertices * 95 / 100);
        EXPECT_EQ(wrongEdges(simple.corners), 0);
        EXPECT_EQ(wrongVertices(simple.corners), 0);
        // Each body of the mesh is at most one of the result.
        std::set<std::int64_t> bodies;
        for (const auto& [before, after] : commonBodies(mesh, simple))
        {
          EXPECT_TRUE(bodies.insert(before).second);
        }
      }
    }
  }
}

} // namespace smg::testing
