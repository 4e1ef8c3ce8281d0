// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Simplify.h"

#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

// Seams: where points of the boundary coincide, the result says so; where others do, it does not.

namespace smg::testing
{
namespace
{

/** The torus with vertices of their own on both sides of the plane x = 0. */
IndexedTestMesh cutTorus()
{
  const IndexedTestMesh whole = torus(200, 120);
  IndexedTestMesh cut = whole;
  std::vector<std::int64_t> other(static_cast<std::size_t>(whole.vertices()), -1);
  for (std::size_t i = 0; i < whole.corners.size(); ++i)
  {
    const std::size_t first = i - i % 3;
    double sum = 0.0;
    for (std::size_t k = first; k < first + 3; ++k)
    {
      sum += whole.positions[3 * static_cast<std::size_t>(whole.corners[k])];
    }
    if (sum < 0.0)
    {
      const auto vertex = static_cast<std::size_t>(whole.corners[i]);
      if (other[vertex] < 0)
      {
        other[vertex] = cut.vertices();
        const auto point = whole.positions.begin() + 3 * static_cast<std::ptrdiff_t>(vertex);
        cut.positions.insert(cut.positions.end(), point, point + 3);
      }
      cut.corners[i] = other[vertex];
    }
  }
  return cut;
}

std::vector<std::string> notesOn(const IndexedTestMesh& mesh, std::int64_t memory)
{
  const TemporaryFolder folder;
  return simplify(MemoryMesh(toStream(mesh), 1000), { .vertices = 2000 }, folder / "simple.vsm",
    { .memoryLimit = memory << 20 })
    .notes;
}

} // namespace

TEST(SimplifySeams, AreSaidWithTheNumberOfTheirPoints)
{
  const IndexedTestMesh cut = cutTorus();
  // Each point of the seams is there twice.
  const std::int64_t seams = toStream(cut).vertices() - 200 * 120;
  ASSERT_GT(seams, 200);
  const std::vector<std::string> notes = notesOn(cut, 256);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("coincide at " + std::to_string(seams) + " places"), std::string::npos)
    << notes[0];
  EXPECT_NE(notes[0].find("--weld 0"), std::string::npos);
  // In parts, points that several of them have are not counted.
  const std::vector<std::string> inParts = notesOn(cut, 16);
  ASSERT_EQ(inParts.size(), 1U);
  EXPECT_NE(inParts[0].find("Points of the boundary coincide"), std::string::npos);
}

TEST(SimplifySeams, AreOnlyOfBoundaries)
{
  for (const std::int64_t memory : { 256, 16 })
  {
    EXPECT_TRUE(notesOn(torus(200, 120), memory).empty());
    EXPECT_TRUE(notesOn(grid(200, 120), memory).empty());
    // Closed bodies at the same place have no boundary.
    EXPECT_TRUE(notesOn(disjointUnion(sphere(5), sphere(5)), memory).empty());
  }
}

} // namespace smg::testing
