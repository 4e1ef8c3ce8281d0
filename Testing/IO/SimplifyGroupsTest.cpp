// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/SimplifyFixture.h"

#include "Testing/Support/TestMeshes.h"

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>

// The law of edges in groups: on a flat plate with straight lines in groups, each group is after a
// simplification the same line, with the same ends, of edges that one triangle names. So are the
// borders between groups of triangles.

namespace smg::testing
{
namespace
{

constexpr std::int64_t Width = 81, Height = 61;

using Edge = std::pair<std::int64_t, std::int64_t>;

double at(const StreamMesh& mesh, std::int64_t v, std::size_t axis)
{
  return mesh.positions[3 * static_cast<std::size_t>(v) + axis];
}

double lengthOf(const StreamMesh& mesh, const Edge& edge)
{
  return std::hypot(at(mesh, edge.first, 0) - at(mesh, edge.second, 0),
    at(mesh, edge.first, 1) - at(mesh, edge.second, 1));
}

/** The edge opposite to corner k of triangle c. */
Edge edgeOf(const StreamMesh& mesh, std::int64_t c, int k)
{
  return std::minmax(mesh.corners[3 * c + (k + 1) % 3], mesh.corners[3 * c + (k + 2) % 3]);
}

const Column& columnOf(const StreamMesh& mesh, const std::string& name)
{
  return *std::ranges::find_if(
    mesh.cellColumns, [&](const Column& column) { return column.spec.name == name; });
}

/** Lines: across the plate, a piece in it, a part of the boundary that another one continues, and
 * one that two groups have. Triangles right of x = 60 are in a group. */
StreamMesh platesWithLines()
{
  IndexedTestMesh indexed = grid(Width, Height);
  for (std::size_t v = 0; v < static_cast<std::size_t>(indexed.vertices()); ++v)
  {
    indexed.positions[3 * v] = static_cast<double>(v % Width);
    indexed.positions[3 * v + 1] = static_cast<double>(v / Width);
    indexed.positions[3 * v + 2] = 0.0;
  }
  StreamMesh mesh = toStream(shuffled(indexed));
  mesh.groups.groups = { { "across", 1, GroupOf::Facets }, { "piece", {}, GroupOf::Facets },
    { "inlet", {}, GroupOf::Facets }, { "wall", {}, GroupOf::Facets },
    { "right", {}, GroupOf::Cells } };
  mesh.groups.sets = { {}, { 0 }, { 1 }, { 2 }, { 3 }, { 1, 3 }, { 4 } };
  const auto setOf = [&](const Edge& edge) -> GroupSet
  {
    const auto lies = [&](std::size_t axis, double place, double low, double high)
    {
      const auto isOn = [&](std::int64_t v)
      {
        return at(mesh, v, axis) == place && at(mesh, v, 1 - axis) >= low &&
               at(mesh, v, 1 - axis) <= high;
      };
      return isOn(edge.first) && isOn(edge.second);
    };
    return lies(0, 40.0, 0.0, 60.0)    ? 1
           : lies(0, 20.0, 10.0, 50.0) ? 2
           : lies(1, 0.0, 0.0, 20.0)   ? 3
           : lies(1, 0.0, 20.0, 33.0)  ? 4
           : lies(1, 30.0, 45.0, 55.0) ? 5
                                       : 0;
  };
  std::vector<GroupSet> edges, cells;
  std::set<Edge> seen;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    double middle = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const Edge edge = edgeOf(mesh, c, k);
      edges.push_back(seen.insert(edge).second ? setOf(edge) : GroupSet(0));
      middle += at(mesh, mesh.corners[3 * c + k], 0) / 3.0;
    }
    cells.push_back(middle > 60.0 ? 6 : 0);
  }
  mesh.cellColumns = { makeColumn<GroupSet>(FacetGroupsName, edges, 3),
    makeColumn<GroupSet>(CellGroupsName, cells) };
  return mesh;
}

/** The edges of each set. */
std::map<int, std::set<Edge>> edgesOf(const StreamMesh& mesh)
{
  std::map<int, std::set<Edge>> found;
  std::set<Edge> all;
  const Column& sets = columnOf(mesh, FacetGroupsName);
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    for (int k = 0; k < 3; ++k)
    {
      if (const int set = static_cast<int>(sets.value(static_cast<std::size_t>(c), k)); set > 0)
      {
        EXPECT_TRUE(all.insert(edgeOf(mesh, c, k)).second) << "two triangles name an edge";
        found[set].insert(edgeOf(mesh, c, k));
      }
    }
  }
  return found;
}

/** Expects the edges to be a line from one place to another. */
void expectLine(const StreamMesh& mesh, const std::set<Edge>& edges, std::size_t axis, double place,
  double low, double high)
{
  double length = 0.0, least = high, most = low;
  for (const Edge& edge : edges)
  {
    for (const std::int64_t v : { edge.first, edge.second })
    {
      EXPECT_EQ(at(mesh, v, axis), place);
      least = std::min(least, at(mesh, v, 1 - axis));
      most = std::max(most, at(mesh, v, 1 - axis));
    }
    length += lengthOf(mesh, edge);
  }
  EXPECT_EQ(least, low);
  EXPECT_EQ(most, high);
  EXPECT_NEAR(length, high - low, 1e-9);
}

} // namespace

class SimplifyGroups : public SimplifyFixture
{
};

TEST_F(SimplifyGroups, KeepTheirLinesAndBorders)
{
  const StreamMesh mesh = platesWithLines();
  for (const std::int64_t memory : { 256, 16 })
  {
    for (const std::int64_t vertices : { 60, 400, 3000 })
    {
      SCOPED_TRACE("to " + std::to_string(vertices) + " in " + std::to_string(memory));
      const StreamMesh simple = this->simplified(mesh, { .vertices = vertices }, memory);
      EXPECT_LE(this->Report.vertices, vertices);
      EXPECT_TRUE(this->Report.notes.empty());
      std::map<int, std::set<Edge>> edges = edgesOf(simple);
      expectLine(simple, edges[1], 0, 40.0, 0.0, 60.0);
      expectLine(simple, edges[2], 0, 20.0, 10.0, 50.0);
      expectLine(simple, edges[3], 1, 0.0, 0.0, 20.0);
      expectLine(simple, edges[4], 1, 0.0, 20.0, 33.0);
      expectLine(simple, edges[5], 1, 30.0, 45.0, 55.0);
      EXPECT_EQ(edges.size(), 5U);
      std::map<Edge, std::set<double>> sides;
      for (std::int64_t c = 0; c < simple.cells(); ++c)
      {
        for (int k = 0; k < 3; ++k)
        {
          sides[edgeOf(simple, c, k)].insert(
            columnOf(simple, CellGroupsName).value(static_cast<std::size_t>(c)));
        }
      }
      std::erase_if(sides, [](const auto& each) { return each.second.size() < 2; });
      std::set<Edge> border;
      for (const auto& [edge, groups] : sides)
      {
        border.insert(edge);
      }
      expectLine(simple, border, 0, 60.0, 0.0, 60.0);
    }
  }
}

/** Fewer vertices than borders need: what is left of the lines, a note says. */
TEST_F(SimplifyGroups, AreGivenUpForTheNumberWhichIsSaid)
{
  EXPECT_LE(this->simplified(platesWithLines(), { .vertices = 6 }).vertices(), 6);
  EXPECT_TRUE(this->isSaid("edges in groups"));
}

} // namespace smg::testing
