// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/SimplifyFixture.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "Testing/Support/Unwelded.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

// The law of held points: each that is on the surface is in the result with the same bits, whatever
// number is asked for, in one window and in parts, of one body, of many, and of loose triangles.

namespace smg::testing
{
namespace
{

IndexedTestMesh balls(int number)
{
  IndexedTestMesh mesh;
  for (int k = 0; k < number; ++k)
  {
    mesh = disjointUnion(mesh, sphere(2), { 3.0 * k, 0, 0 });
  }
  return mesh;
}

/** The positions of the vertices by their numbers in the stream of the mesh. */
std::map<std::int64_t, std::array<double, 3>> pointsOf(const StreamMesh& simple)
{
  std::map<std::int64_t, std::array<double, 3>> points;
  for (std::size_t v = 0; v < static_cast<std::size_t>(simple.vertices()); ++v)
  {
    points[static_cast<std::int64_t>(simple.vertexColumns.back().value(v))] = {
      simple.positions[3 * v], simple.positions[3 * v + 1], simple.positions[3 * v + 2]
    };
  }
  return points;
}

class SimplifyHold : public SimplifyFixture
{
};

} // namespace

TEST_F(SimplifyHold, HeldPointsAreInTheResult)
{
  const std::vector<std::pair<std::string, IndexedTestMesh>> meshes{
    { "torus", torus(220, 150, 0.2) }, { "plate", grid(220, 150, 0.1) }, { "balls", balls(150) },
    { "loose triangles", unwelded(torus(100, 60, 0.2)) }
  };
  const Region part = smg::sphere({ 1.0, 1.0, 0.0 }, 0.7);
  for (const auto& [name, indexed] : meshes)
  {
    const StreamMesh mesh = toStream(shuffled(indexed));
    std::vector<std::int64_t> held;
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      if (v % 97 == 0 || part.contains(std::span<const double, 3>(&mesh.positions[3 * v], 3), v))
      {
        held.push_back(v);
      }
    }
    std::vector<std::int64_t> some;
    for (std::int64_t v = 0; v < mesh.vertices(); v += 97)
    {
      some.push_back(v);
    }
    for (const std::int64_t memory : { 256, 16 })
    {
      for (const SimplifyTarget& target : { SimplifyTarget{ 100, 0.0 }, { 3000, 0.0 }, { 0, 0.5 } })
      {
        SCOPED_TRACE(
          name + " to " + std::to_string(target.vertices) + " in " + std::to_string(memory));
        const StreamMesh simple = this->simplified(mesh, target,
          { .hold = { part, Region::Vertices{ some } }, .memoryLimit = memory << 20 });
        const auto points = pointsOf(simple);
        for (const std::int64_t v : held)
        {
          const auto found = points.find(v);
          ASSERT_NE(found, points.end()) << v;
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            ASSERT_EQ(found->second[axis], mesh.positions[3 * static_cast<std::size_t>(v) + axis]);
          }
        }
        if (target.vertices == 3000)
        {
          EXPECT_LE(simple.vertices(), 3000);
        }
        const auto number = static_cast<std::int64_t>(held.size());
        if (target.vertices > 0 && number > target.vertices)
        {
          ASSERT_FALSE(this->Report.notes.empty());
          EXPECT_NE(this->Report.notes.back().find(
                      "more than 100 vertices: " + std::to_string(number) + " are held."),
            std::string::npos)
            << this->Report.notes.back();
        }
        EXPECT_EQ(simple.vertexColumns.size(), 1U);
      }
    }
  }
}

/** Loose triangles, which are merged by their places: those with a held corner stay, and are more
 * than the vertices that are asked for. */
TEST_F(SimplifyHold, LeavesARestOfWhatIsNotHeld)
{
  IndexedTestMesh apart = unwelded(torus(100, 60, 0.2));
  for (std::size_t i = 0; i < apart.positions.size(); ++i)
  {
    apart.positions[i] += 1e-9 * static_cast<double>(i); // no two at one place
  }
  const StreamMesh mesh = toStream(apart);
  std::vector<std::int64_t> held;
  for (std::int64_t v = 0; v < mesh.vertices(); v += 24)
  {
    held.push_back(v);
  }
  const auto corners = static_cast<std::int64_t>(3 * held.size());
  const StreamMesh simple = this->simplified(
    mesh, { .vertices = 2 * corners / 3 }, { .hold = { Region::Vertices{ held } } });
  EXPECT_GT(simple.vertices(), corners + corners / 24);
  EXPECT_LT(simple.vertices(), mesh.vertices() / 2);
}

TEST_F(SimplifyHold, DoesNotDependOnThreads)
{
  const StreamMesh mesh = toStream(torus(220, 150, 0.2));
  const std::vector<Where> hold{ smg::box({ 0, 0, -1 }, { 3, 1, 1 }) };
  const auto with = [&](int threads)
  {
    return this->simplified(mesh, { .vertices = 4000 },
      { .hold = hold, .memoryLimit = std::int64_t(16) << 20, .threads = threads });
  };
  const StreamMesh one = with(1), several = with(3);
  EXPECT_EQ(one.corners, several.corners);
  EXPECT_EQ(one.positions, several.positions);
}

TEST_F(SimplifyHold, PointsOfNoTriangleAreCounted)
{
  const StreamMesh solid = toStream(tetBox(12, 12, 12));
  const StreamMesh simple =
    this->simplified(solid, { .vertices = 900 }, { .hold = { Everywhere() } });
  EXPECT_EQ(simple.vertices(), 12 * 12 * 12 - 10 * 10 * 10);
  ASSERT_EQ(this->Report.notes.size(), 1U);
  EXPECT_NE(this->Report.notes[0].find("1000 of the 1728 held points are in no triangle"),
    std::string::npos);
}

TEST_F(SimplifyHold, TooManyPointsForTheMemoryAreNamed)
{
  const StreamMesh mesh = toStream(torus(400, 300));
  expectError(
    [&]
    {
      this->simplified(mesh, { .vertices = 100 },
        { .hold = { Everywhere() }, .memoryLimit = std::int64_t(16) << 20 });
    },
    "or hold fewer vertices");
}

TEST_F(SimplifyHold, APartWithoutVerticesIsRefused)
{
  const StreamMesh mesh = toStream(sphere(3));
  expectError(
    [&] {
      this->simplified(mesh, { .vertices = 100 }, { .hold = { smg::sphere({ 9, 9, 9 }, 1.0) } });
    },
    "hold[0]");
}

} // namespace smg::testing
