// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/AllJobs.h"
#include "smg/DeformationDescription.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <vector>

// Facets in a group hold what their corners hold: the jobs that hold parts of a mesh have the same
// bits as with these vertices by their numbers.

namespace smg::testing
{
namespace
{

/** A mesh with a rim: a group of random facets, inside and on the boundary. */
struct Rimmed
{
  StreamMesh mesh;
  Region::Vertices corners;
};

Rimmed rimmed(StreamMesh mesh)
{
  const auto size = static_cast<std::size_t>(cornersOf(mesh.cellType));
  mesh.groups.groups = { { "rim", 3, GroupOf::Facets } };
  mesh.groups.sets = { {}, { 0 } };
  Random random(8);
  std::vector<GroupSet> sets(mesh.corners.size(), 0);
  std::set<std::int64_t> corners;
  for (std::size_t k = 0; k < 12; ++k)
  {
    const auto facet = static_cast<std::size_t>(random.below(std::ssize(sets)));
    sets[facet] = 1;
    for (std::size_t e = 0; e < size; ++e)
    {
      if (e != facet % size)
      {
        corners.insert(mesh.corners[facet / size * size + e]);
      }
    }
  }
  mesh.cellColumns.push_back(makeColumn<GroupSet>(FacetGroupsName, sets, static_cast<int>(size)));
  return { std::move(mesh), { { corners.begin(), corners.end() } } };
}

using Job = std::function<std::unique_ptr<Solution>(const StoredMesh&, const Where&)>;

void expectSameByGroup(const Rimmed& rim, const Job& job)
{
  const MemoryMesh mesh(rim.mesh);
  const auto byGroup = job(mesh, InGroup{ { "rim" } });
  const auto byNumbers = job(mesh, Region(rim.corners));
  EXPECT_TRUE(sameBits(valuesOf(*byGroup), valuesOf(*byNumbers)));
}

} // namespace

TEST(HeldGroups, AreTheCornersOfTheirFacets)
{
  const Rimmed surface = rimmed(toStream(sphere(3)));
  expectSameByGroup(surface,
    [](const StoredMesh& mesh, const Where& rim)
    {
      Smoothing options;
      options.steps = 2;
      options.hold = { rim };
      return smooth(mesh, options, options);
    });
  expectSameByGroup(surface,
    [](const StoredMesh& mesh, const Where& rim)
    {
      DeformationDescription description;
      const HandleMotion moved({ .translation = { 0.1, 0.0, 0.2 } });
      description.handles = { { rim, HandleMotion() },
        { Region::HalfSpace{ { 0, 0, 1 }, 0.9 }, moved } };
      return deform(mesh, description);
    });
  for (StreamMesh mesh : { toStream(sphere(3)), toStream(tetBox(5, 5, 5)) })
  {
    addColumn<std::int32_t>(mesh, "patch", { quarter });
    addColumn(mesh, "signal", { recordedSignal });
    expectSameByGroup(rimmed(mesh),
      [](const StoredMesh& stored, const Where& rim)
      {
        BlendDescription description = blendOf({ "signal" });
        description.hold = { rim };
        return blend(stored, description, SolveOptions());
      });
  }
}

/** The vertices that a smoothing or a blend holds stay where they are, bit for bit. */
TEST(HeldGroups, StayWhereTheyAre)
{
  const Rimmed surface = rimmed(toStream(sphere(3)));
  const MemoryMesh mesh(surface.mesh);
  Smoothing options;
  options.steps = 2;
  options.hold = { InGroup{ { "rim" } } };
  const Eigen::MatrixXd values = valuesOf(*smooth(mesh, options, options));
  std::int64_t moved = 0;
  for (std::int64_t v = 0; v < surface.mesh.vertices(); ++v)
  {
    const bool isHeld = std::ranges::find(surface.corners.ids, v) != surface.corners.ids.end();
    const bool stays = values.row(v) == Eigen::RowVector3d::Map(&surface.mesh.positions[3 * v]);
    EXPECT_TRUE(stays || !isHeld);
    moved += stays ? 0 : 1;
  }
  EXPECT_GT(moved, surface.mesh.vertices() / 2);
}

} // namespace smg::testing
