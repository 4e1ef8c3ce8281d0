// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/SimplifyFixture.h"

#include "Solver/Core/DisjointSets.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/VsmReader.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

// The law of labels: every label of the cells has after a simplification as many regions as before
// and nearly the same area, and the borders between them have nearly the same length.

namespace smg::testing
{
namespace
{

Eigen::Vector3d pointOf(const StreamMesh& mesh, std::size_t corner)
{
  return Eigen::Map<const Eigen::Vector3d>(&mesh.positions[3 * mesh.corners[corner]]);
}

/** What the labels in the first column of the cells cover. */
struct Cover
{
  std::map<double, double> areas;
  std::map<double, int> regions; ///< connected by edges
  double borders = 0.0;          ///< length of the edges between labels
  double boundary = 0.0;         ///< length of the edges of one triangle
};

Cover coverOf(const StreamMesh& mesh)
{
  Cover cover;
  const Column& labels = mesh.cellColumns.front();
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::size_t>> edges;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i)
  {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    edges[std::minmax(mesh.corners[i], mesh.corners[next])].push_back(i);
  }
  const auto cells = static_cast<std::size_t>(mesh.cells());
  DisjointSets<std::size_t> sets(cells);
  for (const auto& [edge, uses] : edges)
  {
    const std::size_t at = uses.front(), next = at % 3 == 2 ? at - 2 : at + 1;
    const double length = (pointOf(mesh, at) - pointOf(mesh, next)).norm();
    cover.boundary += uses.size() == 1 ? length : 0.0;
    for (const std::size_t use : uses)
    {
      const bool isAlike = labels.value(use / 3) == labels.value(at / 3);
      cover.borders += isAlike ? 0.0 : length;
      if (isAlike)
      {
        sets.join(use / 3, at / 3);
      }
    }
  }
  for (std::size_t t = 0; t < cells; ++t)
  {
    const Eigen::Vector3d a = pointOf(mesh, 3 * t), b = pointOf(mesh, 3 * t + 1),
                          c = pointOf(mesh, 3 * t + 2);
    cover.areas[labels.value(t)] += 0.5 * (b - a).cross(c - a).norm();
    cover.regions[labels.value(t)] += sets.first(t) == t ? 1 : 0;
  }
  return cover;
}

/** The mesh with a column of labels, by the middles of its triangles. */
template <class T>
StreamMesh labelled(
  const IndexedTestMesh& indexed, const std::function<T(const Eigen::Vector3d&)>& labelOf)
{
  StreamMesh mesh = toStream(shuffled(indexed));
  std::vector<T> labels;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
  {
    labels.push_back(
      labelOf((pointOf(mesh, i) + pointOf(mesh, i + 1) + pointOf(mesh, i + 2)) / 3.0));
  }
  mesh.cellColumns = { makeColumn<T>("Label", labels) };
  return mesh;
}

/** A plate with waves, of about the size 1, around the origin. */
IndexedTestMesh plate()
{
  IndexedTestMesh plate = grid(220, 160, 0.2);
  for (std::size_t i = 0; i < plate.positions.size(); i += 3)
  {
    double* p = plate.positions.data() + i;
    p[0] = 0.005 * p[0] - 0.53;
    p[1] = 0.005 * p[1] - 0.37;
    p[2] = 0.03 * std::sin(9.0 * p[0]) * std::cos(7.0 * p[1]);
  }
  return plate;
}

/** Labels in three sectors around the z axis, where they meet. */
std::int16_t sectorOf(const Eigen::Vector3d& middle)
{
  return static_cast<std::int16_t>(std::floor((std::atan2(middle.y(), middle.x()) + 3.2) / 2.2));
}

/** Spots with labels of their own on a ground of one label. */
std::int64_t spotOf(const Eigen::Vector3d& middle)
{
  const double x = 6.0 * middle.x(), y = 6.0 * middle.y();
  const bool isSpot = std::hypot(x - std::round(x), y - std::round(y)) < 0.25;
  return isSpot ? static_cast<std::int64_t>(1000.0 * std::round(x) + std::round(y)) : -1;
}

class SimplifyLabels : public SimplifyFixture
{
};

} // namespace

TEST_F(SimplifyLabels, KeepTheirRegionsAndBorders)
{
  const std::vector<std::pair<std::string, StreamMesh>> meshes{
    { "sectors of a plate", labelled<std::int16_t>(plate(), sectorOf) },
    { "sectors of a ball", labelled<std::int16_t>(sphere(6), sectorOf) },
    { "spots", labelled<std::int64_t>(plate(), spotOf) },
    { "one byte", labelled<std::uint8_t>(sphere(6),
                    [](const Eigen::Vector3d& middle) { return middle.x() < 0.3 ? 200 : 7; }) }
  };
  Combinations chosen;
  for (const auto& [name, mesh] : meshes)
  {
    const Cover before = coverOf(mesh);
    double whole = 0.0;
    std::ranges::for_each(before.areas, [&whole](const auto& each) { whole += each.second; });
    // Of a triangle: by about so much a border may move.
    const double size = std::sqrt(whole / static_cast<double>(mesh.cells()));
    for (const std::int64_t memory : { 256, 16 })
    {
      for (const std::int64_t vertices : { 1000, 5000 })
      {
        if (!chosen.next())
        {
          continue;
        }
        SCOPED_TRACE(name + " to " + std::to_string(vertices) + " in " + std::to_string(memory));
        const Cover after = coverOf(this->simplified(mesh, { .vertices = vertices }, memory));
        EXPECT_LE(this->Report.vertices, vertices);
        EXPECT_TRUE(this->Report.notes.empty());
        EXPECT_EQ(after.regions, before.regions);
        for (const auto& [label, area] : before.areas)
        {
          EXPECT_NEAR(after.areas.at(label), area, 0.01 * area + 1.5 * size * std::sqrt(area))
            << label;
        }
        // Curves along the sides of small triangles are jagged before.
        EXPECT_LT(after.borders, 1.02 * before.borders);
        EXPECT_GT(after.borders, 0.7 * before.borders);
        EXPECT_NEAR(after.boundary, before.boundary, 0.05 * before.boundary);
      }
    }
  }
}

TEST_F(SimplifyLabels, AreGivenUpForTheNumberWhichIsSaid)
{
  const StreamMesh mesh = labelled<std::int64_t>(plate(), spotOf);
  EXPECT_LE(this->simplified(mesh, { .vertices = 60 }).vertices(), 60);
  ASSERT_EQ(this->Report.notes.size(), 1U);
  EXPECT_NE(this->Report.notes[0].find("borders between the labels"), std::string::npos);
  // An error gives up none.
  const SimplifyReport report =
    simplify(MemoryMesh(mesh, 1000), { .vertices = 60, .error = 1.0 }, this->Folder / "both.vsm");
  EXPECT_EQ(coverOf(collect(*VsmReader(this->Folder / "both.vsm").source())).regions,
    coverOf(mesh).regions);
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find("more than 60 vertices"), std::string::npos);
}

/** Whatever is asked for: labels keep their shares of the area, or a note says that they do not. */
TEST_F(SimplifyLabels, KeepTheirSharesOfTheAreaOrANoteSaysSo)
{
  const auto nine = [](const Eigen::Vector3d& middle)
  {
    const auto third = [](double x) { return std::clamp(static_cast<int>(x / 0.36 + 1.5), 0, 2); };
    return static_cast<std::uint8_t>(3 * third(middle.x()) + third(middle.y()));
  };
  const std::vector<std::pair<std::string, StreamMesh>> meshes{
    { "nine of a plate", labelled<std::uint8_t>(plate(), nine) },
    { "nine of a ball", labelled<std::uint8_t>(sphere(5), nine) },
    { "sectors of a ball", labelled<std::int16_t>(sphere(5), sectorOf) },
    { "spots", labelled<std::int64_t>(plate(), spotOf) }
  };
  Combinations chosen;
  int said = 0, kept = 0;
  for (const auto& [name, mesh] : meshes)
  {
    const Cover before = coverOf(mesh);
    for (const std::int64_t memory : { 256, 16 })
    {
      for (const std::int64_t vertices : { 4, 8, 12, 20, 40, 100, 400, 2000 })
      {
        if (!chosen.next())
        {
          continue;
        }
        SCOPED_TRACE(name + " to " + std::to_string(vertices) + " in " + std::to_string(memory));
        Cover after = coverOf(this->simplified(mesh, { .vertices = vertices }, memory));
        const auto wholeOf = [](const Cover& cover)
        {
          double whole = 0.0;
          std::ranges::for_each(cover.areas, [&](const auto& each) { whole += each.second; });
          return whole;
        };
        bool isKept = true;
        for (const auto& [label, area] : before.areas)
        {
          const double share = area / wholeOf(before);
          isKept = isKept && std::fabs(after.areas[label] / wholeOf(after) - share) <= 0.2 * share;
        }
        EXPECT_NE(isKept, this->isSaid("labels in 'Label'"));
        ++(isKept ? kept : said);
      }
    }
  }
  EXPECT_GT(said, Sanitized ? 2 : 20);
  EXPECT_GT(kept, Sanitized ? 2 : 20);
}

TEST_F(SimplifyLabels, AreNotValuesThatChangeFromCellToCell)
{
  StreamMesh mesh = toStream(torus(120, 80, 0.2));
  const SimplifyTarget target{ .error = 0.05 };
  const SimplifyReport plain = simplify(MemoryMesh(mesh, 1000), target, this->Folder / "plain.vsm");
  EXPECT_LT(plain.vertices, mesh.vertices() / 2);
  std::vector<std::uint8_t> grey;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    grey.push_back(static_cast<std::uint8_t>(c * 7919 % 200));
  }
  mesh.cellColumns = { makeColumn<std::uint8_t>("Grey", grey) };
  const SimplifyReport report = simplify(MemoryMesh(mesh, 1000), target, this->Folder / "grey.vsm");
  EXPECT_EQ(report.vertices, plain.vertices);
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find("'Grey' has too many values"), std::string::npos);
}

TEST_F(SimplifyLabels, AreNotTheNumbersOfCells)
{
  StreamMesh mesh = toStream(torus(120, 80, 0.2));
  std::vector<std::int32_t> numbers;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    numbers.push_back(static_cast<std::int32_t>(c));
  }
  mesh.cellColumns = { makeColumn<std::int32_t>("Number", numbers) };
  for (const std::int64_t memory : { 256, 16 })
  {
    EXPECT_EQ(this->simplified(mesh, { .vertices = 500 }, memory).vertices(), 500);
    ASSERT_EQ(this->Report.notes.size(), 1U);
    EXPECT_NE(this->Report.notes[0].find("'Number' has too many values"), std::string::npos);
  }
}

} // namespace smg::testing
