// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/BodyOfVertices.h"
#include "Testing/IO/SimplifyFixture.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

// The law of the number of vertices: a mesh of whatever bodies is simplified to the number that is
// asked for, at most VerticesOfBody - 1 fewer, and bodies that are not in the result are counted,
// and those for which there is no room.

namespace smg::testing
{
namespace
{

/** So many bodies beside one another, the k-th `size(k)` times as large. */
IndexedTestMesh bodiesOf(
  const IndexedTestMesh& body, int number, const std::function<double(int)>& size)
{
  IndexedTestMesh mesh;
  for (int k = 0; k < number; ++k)
  {
    const std::int64_t first = mesh.vertices();
    for (std::size_t i = 0; i < body.positions.size(); ++i)
    {
      mesh.positions.push_back(size(k) * body.positions[i] + (i % 3 == 0 ? 3.0 * k : 0.0));
    }
    for (const std::int64_t corner : body.corners)
    {
      mesh.corners.push_back(first + corner);
    }
  }
  return mesh;
}

IndexedTestMesh together(IndexedTestMesh one, const IndexedTestMesh& other)
{
  return disjointUnion(one, other, { -1000.0, 0.0, 0.0 });
}

/** The number of bodies of which no vertex is in the simplified mesh. */
std::int64_t missing(const std::vector<std::int64_t>& bodies, const StreamMesh& simple)
{
  std::set<std::int64_t> all(bodies.begin(), bodies.end());
  for (std::size_t v = 0; v < static_cast<std::size_t>(simple.vertices()); ++v)
  {
    all.erase(bodies[static_cast<std::size_t>(simple.vertexColumns.back().value(v))]);
  }
  return static_cast<std::int64_t>(all.size());
}

struct Bodies
{
  const char* name;
  IndexedTestMesh mesh;
  std::int64_t least = 1 << 20; ///< vertices that each of equal bodies needs
};

std::vector<Bodies> kindsOfBodies()
{
  IndexedTestMesh tetrahedron;
  tetrahedron.positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  tetrahedron.corners = { 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2 };
  const auto equal = [](int) { return 1.0; };
  const auto falling = [](int k) { return std::pow(0.995, k); };
  return { { "one", sphere(5) }, { "one open", grid(120, 100, 0.1) },
    { "tetrahedra", bodiesOf(tetrahedron, 2000, equal), 4 },
    { "balls of few vertices", bodiesOf(sphere(0), 2000, equal), 12 },
    { "balls", bodiesOf(sphere(1), 2000, equal), 20 },
    { "patches", bodiesOf(grid(3, 2), 2000, equal), 4 },
    { "flat patches of many vertices", bodiesOf(grid(31, 2), 400, [](int) { return 0.0625; }), 4 },
    { "balls of all sizes", bodiesOf(sphere(1), 1000, falling) },
    { "few large, many small",
      together(sphere(5), bodiesOf(sphere(0), 1500, [](int) { return 0.01; })) },
    { "a large open one, many small patches",
      together(grid(120, 100, 0.1), bodiesOf(grid(2, 2), 1500, [](int) { return 0.01; })) } };
}

} // namespace

using SimplifyLaw = SimplifyFixture;

TEST_F(SimplifyLaw, TheNumberAskedForIsReached)
{
  for (const auto& [name, indexed, least] : kindsOfBodies())
  {
    for (const unsigned seed : { 1U, 2U })
    {
      const StreamMesh mesh = toStream(shuffled(indexed, seed));
      const std::vector<std::int64_t> bodies = bodyOfVertices(mesh);
      const auto number = static_cast<std::int64_t>(std::set(bodies.begin(), bodies.end()).size());
      for (const std::int64_t memory : { 256, 16 })
      {
        for (const std::int64_t vertices : { 100, 1234, 5000, 7500 })
        {
          SCOPED_TRACE(std::string(name) + " to " + std::to_string(vertices) + " in " +
                       std::to_string(memory) + " MiB, seed " + std::to_string(seed));
          const StreamMesh simple = this->simplified(mesh, { .vertices = vertices }, memory);
          const SimplifyReport& report = this->Report;
          EXPECT_LE(report.vertices, vertices);
          // A result in parts, with little memory, may have 2 % fewer.
          const std::int64_t share = memory == 16 ? vertices * 98 / 100 : vertices;
          EXPECT_GT(report.vertices, std::min(share, mesh.vertices()) - 20);
          EXPECT_EQ(report.dropped_bodies, missing(bodies, simple));
          EXPECT_LE(
            report.dropped_bodies, std::max<std::int64_t>(0, number - report.vertices / least));
        }
      }
    }
  }
}

/** A number of at least the vertices, too, changes nothing, even of a result in parts. */
TEST_F(SimplifyLaw, AllVerticesAreLeftWhereAllAreAskedFor)
{
  const StreamMesh mesh = toStream(shuffled(torus(300, 200, 0.2)));
  for (const std::int64_t memory : { 256, 16 })
  {
    for (const std::int64_t more : { 0, 1, 10, 100000 })
    {
      const StreamMesh simple =
        this->simplified(mesh, { .vertices = mesh.vertices() + more }, memory);
      EXPECT_EQ(simple.vertices(), mesh.vertices()) << more;
      EXPECT_EQ(simple.cells(), mesh.cells()) << more;
      EXPECT_EQ(this->Report.error, 0.0);
    }
    // As few more go as must.
    this->simplified(mesh, { .vertices = mesh.vertices() - 100 }, memory);
    EXPECT_LE(this->Report.vertices, mesh.vertices() - 100);
    EXPECT_GE(this->Report.vertices, mesh.vertices() - 200);
  }
}

} // namespace smg::testing
