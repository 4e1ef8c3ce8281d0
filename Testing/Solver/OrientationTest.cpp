// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/Orientation.h"

#include "Solver/Jobs/Fairing/OrientedMesh.h"
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/DirectSmoothing.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/Sanitized.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

/** The mesh with a third of its triangles turned at random. */
StreamMesh woundAnyhow(const IndexedTestMesh& mesh, std::uint64_t seed, TestOrder order)
{
  IndexedTestMesh wound = mesh;
  Random random(seed);
  for (std::size_t c = 0; c < wound.corners.size(); c += 3)
  {
    if (random.below(3) == 0)
    {
      std::swap(wound.corners[c + 1], wound.corners[c + 2]);
    }
  }
  return toStream(wound, order);
}

/** Of each edge of two triangles, how often these run along it in either direction. */
bool isWoundAlike(const StreamMesh& mesh)
{
  std::map<std::pair<std::int64_t, std::int64_t>, std::array<int, 2>> edges;
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::int64_t a = mesh.corners[c + k], b = mesh.corners[c + (k + 1) % 3];
      ++edges[std::minmax(a, b)][a < b ? 0 : 1];
    }
  }
  return std::ranges::all_of(
    edges, [](const auto& edge) { return edge.second[0] < 2 && edge.second[1] < 2; });
}

/** The corners of a triangle by their places in space, beginning with the least of them. */
using Places = std::array<std::array<double, 3>, 3>;
Places placesOf(const StreamMesh& mesh, std::size_t cell)
{
  Places places;
  for (std::size_t k = 0; k < 3; ++k)
  {
    std::copy_n(&mesh.positions[3 * static_cast<std::size_t>(mesh.corners[3 * cell + k])], 3,
      places[k].begin());
  }
  std::ranges::rotate(places, std::ranges::min_element(places));
  return places;
}

/** Finds how the mesh is to be wound, and returns it wound so. */
StreamMesh wellWound(const StreamMesh& mesh, std::int64_t blockCells, Orientation& winding)
{
  winding.find(
    [&](const Orientation::Visit& visit)
    {
      MemorySource read(mesh, blockCells);
      for (MeshBlock block; read.next(block);)
      {
        visit(block);
      }
    });
  return collect(
    *numberedByFirstUse(oriented(std::make_unique<MemorySource>(mesh, blockCells), winding)));
}

/** A hub with a ring of triangles around it. */
IndexedTestMesh fan(std::int64_t triangles)
{
  IndexedTestMesh mesh{ CellType::Triangle, { 0, 0, 1 }, {} };
  for (std::int64_t k = 0; k < triangles; ++k)
  {
    const double angle =
      2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(triangles);
    mesh.positions.insert(mesh.positions.end(), { std::cos(angle), std::sin(angle), 0.0 });
    mesh.corners.insert(mesh.corners.end(), { 0, 1 + k, 1 + (k + 1) % triangles });
  }
  return mesh;
}

} // namespace

TEST(Orientation, AnySurfaceIsWoundAlikeInAStreamNumberedByFirstUse)
{
  const TemporaryFolder folder;
  const std::vector<IndexedTestMesh> surfaces{ sphere(2), torus(17, 9, 0.2), grid(13, 11, 0.1),
    disjointUnion(sphere(1), grid(5, 4), { 4, 0, 0 }) };
  for (std::uint64_t seed = 0; seed < 40; ++seed)
  {
    const TestOrder order = seed % 2 == 0 ? TestOrder::Keep : TestOrder::BreadthFirst;
    const StreamMesh mesh =
      woundAnyhow(shuffled(surfaces[seed % surfaces.size()], seed), seed, order);
    Pool pool(std::int64_t(1) << 30);
    Orientation winding(pool, folder.path());
    const StreamMesh wound = wellWound(mesh, seed % 3 == 0 ? 7 : 1000, winding);
    EXPECT_TRUE(isWoundAlike(wound)) << seed;
    ASSERT_EQ(wound.cells(), mesh.cells());
    std::vector<std::uint8_t> marks(static_cast<std::size_t>(mesh.cells()));
    winding.read(0, marks);
    std::int64_t used = 0;
    for (std::size_t c = 0; c < marks.size(); ++c)
    {
      Places expected = placesOf(mesh, c);
      if (marks[c] != 0)
      {
        std::swap(expected[1], expected[2]);
      }
      ASSERT_EQ(placesOf(wound, c), expected) << seed << ' ' << c;
      for (std::size_t k = 0; k < 3; ++k)
      {
        ASSERT_LE(wound.corners[3 * c + k], used) << seed << ' ' << c;
        used = std::max(used, wound.corners[3 * c + k] + 1);
      }
    }
    EXPECT_EQ(winding.turned(), std::ranges::count(marks, 1));
  }
}

/** A ball of radius 4 with cavities, which may have balls in them, beside balls within its bounds:
 * well wound, with the volume that it encloses. */
IndexedTestMesh nested(double& volume)
{
  const auto ball = [](double radius, bool isCavity)
  { return turned(resized(sphere(2), radius), [isCavity](std::int64_t) { return isCavity; }); };
  const StreamMesh unit = toStream(sphere(2));
  const double ofUnit = enclosedVolume(unit, positionsOf(unit));
  IndexedTestMesh all = ball(4.0, false);
  volume = 64.0 * ofUnit;
  const auto add = [&](double radius, bool isCavity, const std::array<double, 3>& center)
  {
    all = disjointUnion(all, ball(radius, isCavity), center);
    volume += (isCavity ? -1.0 : 1.0) * radius * radius * radius * ofUnit;
  };
  for (const double side : { -1.0, 1.0 })
  {
    add(1.5, true, { 1.6 * side, 0, 0 });
    add(0.9, false, { 1.6 * side, 0, 0.1 });
    add(0.4, true, { 1.6 * side + 0.2, 0, 0.1 });
    add(0.5, true, { 0, 0, 3.0 * side });
    add(0.6, false, { 3.3, 3.3 * side, -3.3 * side }); // beside it, in a corner of its bounds
    add(0.3, true, { 3.3, 3.3 * side, -3.3 * side });
  }
  return all;
}

TEST(Orientation, WhatLiesInABodyIsWoundWithIt)
{
  const TemporaryFolder folder;
  double volume = 0.0;
  const IndexedTestMesh well = nested(volume);
  const std::int64_t ball = sphere(2).cells(), cells = well.cells();
  for (std::uint64_t seed = 0; seed < 12; ++seed)
  {
    SCOPED_TRACE(seed);
    const bool all = seed % 2 == 0, outer = seed % 3 == 0;
    const IndexedTestMesh wound =
      turned(well, [=](std::int64_t c) { return all || (outer && c < ball && c % 3 == 0); });
    Pool pool(std::int64_t(1) << 30);
    Orientation winding(pool, folder.path());
    const StreamMesh mesh = wellWound(
      toStream(shuffled(wound, seed), TestOrder::BreadthFirst), seed % 4 ? 1000 : 7, winding);
    EXPECT_TRUE(isWoundAlike(mesh));
    EXPECT_NEAR(winding.volume(), volume, 1e-9 * volume);
    EXPECT_NEAR(enclosedVolume(mesh, positionsOf(mesh)), volume, 1e-9 * volume);
    EXPECT_EQ(winding.turned(), all ? cells : outer ? (ball + 2) / 3 : 0);
    EXPECT_EQ(winding.ambiguous() + winding.branched() + winding.unorientable(), 0);
  }
  // Solids within solids stay solids, inside out or not; of what is wound anyhow that is not known.
  for (const bool isTurned : { false, true })
  {
    Pool pool(std::int64_t(1) << 30);
    Orientation winding(pool, folder.path());
    const IndexedTestMesh solids = disjointUnion(sphere(2), resized(sphere(2), 0.5));
    wellWound(toStream(turned(solids, [=](std::int64_t) { return isTurned; })), 1000, winding);
    EXPECT_EQ(winding.turned(), isTurned ? solids.cells() : 0);
    EXPECT_EQ(winding.cavities(), 0.0);
    Orientation anyhow(pool, folder.path());
    wellWound(toStream(turned(solids, [](std::int64_t c) { return c % 3 == 0; })), 1000, anyhow);
    EXPECT_EQ(anyhow.ambiguous(), 1);
  }
}

/** Two boxes that share a face, whose triangles are there once or twice: no part is closed. */
TEST(Orientation, PartsThatEndAtEdgesOfMoreTrianglesHaveNoOutside)
{
  const TemporaryFolder folder;
  constexpr std::int64_t Faces[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
    { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
  for (const bool isTwice : { false, true })
  {
    IndexedTestMesh boxes{ CellType::Triangle, {}, {} };
    for (int v = 0; v < 12; ++v)
    {
      boxes.positions.insert(
        boxes.positions.end(), { double(v & 1), double(v >> 1 & 1), double(v >> 2) });
    }
    for (const std::int64_t above : { 0, 4 })
    {
      for (const auto& face : Faces)
      {
        const bool isShared = above == 4 && face[1] == 2;
        if (isShared && !isTwice)
        {
          continue;
        }
        for (const int k : { 1, 2 })
        {
          boxes.corners.insert(
            boxes.corners.end(), { above + face[0], above + face[k], above + face[k + 1] });
        }
      }
    }
    Pool pool(std::int64_t(1) << 30);
    Orientation winding(pool, folder.path());
    StreamMesh mesh = toStream(boxes, TestOrder::Keep);
    std::vector<std::uint8_t> flags(static_cast<std::size_t>(mesh.cells()));
    if (isTwice)
    {
      flags[12] = flags[13] = DuplicateCell;
    }
    mesh.cellColumns.push_back(makeColumn<std::uint8_t>(CellFlagsName, flags));
    wellWound(mesh, 1000, winding);
    EXPECT_EQ(winding.turned(), 0);
    EXPECT_EQ(winding.branched(), 3);
  }
}

/** Walking the edges of the hub for each of its triangles would take 2e10 steps. */
TEST(Orientation, AHubOfVeryManyTriangles)
{
  const TemporaryFolder folder;
  const StreamMesh mesh = woundAnyhow(fan(Sanitized ? 20000 : 200000), 3, TestOrder::Keep);
  Pool pool(std::int64_t(1) << 30);
  Orientation winding(pool, folder.path());
  EXPECT_TRUE(isWoundAlike(wellWound(mesh, 1000, winding)));
  EXPECT_NEAR(static_cast<double>(winding.turned()), static_cast<double>(mesh.cells()) / 3.0,
    0.01 * static_cast<double>(mesh.cells()));
}

} // namespace smg::testing
