// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/UnmatchedFaces.h"

#include "IO/Import/RawMeshBuilder.h"
#include "IO/Import/Weld.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "Testing/Support/Unwelded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace smg::testing
{
namespace
{

/** The number of unmatched faces of the mesh after it was welded. */
std::int64_t unmatchedOf(const IndexedTestMesh& mesh, double distance = 0.0)
{
  const TemporaryFolder folder;
  Workspace space(folder.path(), Workspace::MinMemory);
  RawMeshBuilder builder(space, CellChoice::Only);
  for (std::size_t v = 0; v < mesh.positions.size(); v += 3)
  {
    builder.vertex(mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]);
  }
  for (std::size_t c = 0; c < mesh.corners.size(); c += 4)
  {
    const std::int64_t* const cell = mesh.corners.data() + c;
    builder.tetrahedron(cell[0], cell[1], cell[2], cell[3]);
  }
  RawMesh raw = builder.finish();
  VertexFilter joined(space, raw.vertices);
  weldPoints(raw, distance, space, &joined);
  return unmatchedFaces(raw, joined, space);
}

/** The mesh mirrored in its box of this width in y, so that the diagonals of its squares are the
 * other ones. */
IndexedTestMesh mirrored(IndexedTestMesh mesh, double width)
{
  for (std::size_t v = 0; v < mesh.positions.size(); v += 3)
  {
    mesh.positions[v + 1] = width - mesh.positions[v + 1];
  }
  for (std::size_t c = 0; c < mesh.corners.size(); c += 4)
  {
    std::swap(mesh.corners[c], mesh.corners[c + 1]);
  }
  return mesh;
}

/** The mesh bent around the z axis. */
IndexedTestMesh bent(IndexedTestMesh mesh, double angle)
{
  for (std::size_t v = 0; v < mesh.positions.size(); v += 3)
  {
    const double radius = 4.0 + mesh.positions[v], turn = angle * mesh.positions[v + 1];
    mesh.positions[v] = radius * std::cos(turn);
    mesh.positions[v + 1] = radius * std::sin(turn);
  }
  return mesh;
}

} // namespace

/** Nothing is left of the faces between cells and between bodies that match, and surfaces stay
 * what they were, also narrow notches, thin edges and cells without a volume. */
TEST(UnmatchedFaces, AreNoneOfMeshesThatMatch)
{
  const IndexedTestMesh box = tetBox(4, 4, 4, 0.1);
  EXPECT_EQ(unmatchedOf(unwelded(box)), 0);
  EXPECT_EQ(unmatchedOf(disjointUnion(tetBox(3, 4, 4), tetBox(5, 4, 4), { 2, 0, 0 })), 0);
  EXPECT_EQ(unmatchedOf(disjointUnion(box, box, { 0, 0, 9 })), 0);
  // Two cubes that touch along an edge.
  EXPECT_EQ(unmatchedOf(disjointUnion(tetBox(2, 2, 2), tetBox(2, 2, 2), { 1, 1, 0 })), 0);
  // A notch, or a thin edge, of one degree.
  const double low = 0.0087;
  const IndexedTestMesh up{ CellType::Tetrahedron,
    { 0, 0, 0, 0, 1, 0, 1, 0.5, low, 0, 0.5, 1, 1, 0.5, 1 }, { 0, 1, 2, 3, 0, 2, 3, 4 } };
  IndexedTestMesh down = up;
  for (std::size_t z = 2; z < down.positions.size(); z += 3)
  {
    down.positions[z] *= -1;
  }
  IndexedTestMesh both = disjointUnion(up, down);
  both.positions.insert(both.positions.end(), { -1, 0.5, 0 });
  both.corners.insert(both.corners.end(), { 0, 1, 3, 10, 5, 6, 8, 10 });
  EXPECT_EQ(unmatchedOf(unwelded(both)), 0);
  const IndexedTestMesh edge{ CellType::Tetrahedron,
    { 0, 0, 0, 0, 1, 0, 1, 0, low, 1, 1, -low, 1, 0.5, 0 }, { 0, 1, 2, 4, 0, 1, 4, 3 } };
  EXPECT_EQ(unmatchedOf(unwelded(edge)), 0);
  const IndexedTestMesh flat{ CellType::Tetrahedron,
    { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1 }, { 0, 1, 2, 3, 0, 1, 2, 4 } };
  EXPECT_EQ(unmatchedOf(unwelded(flat)), 0);
}

/** Faces of the same squares with other diagonals: all of both sides. */
TEST(UnmatchedFaces, AreThoseWithOtherCorners)
{
  const IndexedTestMesh left = tetBox(3, 4, 4), right = mirrored(tetBox(3, 4, 4), 3.0);
  const IndexedTestMesh both = disjointUnion(left, right, { 2, 0, 0 });
  EXPECT_EQ(unmatchedOf(both), 2 * 18);
  EXPECT_EQ(unmatchedOf(shuffled(unwelded(both))), 2 * 18);
  EXPECT_EQ(unmatchedOf(bent(both, 0.1)), 2 * 18);
}

/** Of faces with other vertices, those that have a vertex in common: at the corners of the cubes.
 */
TEST(UnmatchedFaces, AreThoseAtSharedVertices)
{
  const IndexedTestMesh coarse = resized(tetBox(4, 4, 4), 5.0 / 3.0), fine = tetBox(6, 6, 6);
  // At two corners one triangle of each side, at two others two.
  EXPECT_EQ(unmatchedOf(disjointUnion(coarse, fine, { 5, 0, 0 })), 2 * (1 + 2 + 1 + 2));
  EXPECT_EQ(unmatchedOf(disjointUnion(coarse, fine, { 5, 0.1, 0 })), 0);
}

/** One square in the middle of a contact, and a distance that closes a gap. */
TEST(UnmatchedFaces, AreFoundInsideOfContacts)
{
  const IndexedTestMesh left = tetBox(2, 4, 4), &right = left;
  // The middle square of the right side is that of a cube which is mirrored.
  const IndexedTestMesh turnedCube = mirrored(tetBox(2, 2, 2), 1.0);
  IndexedTestMesh rest{ CellType::Tetrahedron, right.positions, {} };
  for (std::size_t c = 0; c < right.corners.size(); c += 4)
  {
    bool isMiddle = true;
    for (std::size_t k = 0; k < 4; ++k)
    {
      const double* at = right.positions.data() + 3 * right.corners[c + k];
      isMiddle = isMiddle && at[1] >= 1 && at[1] <= 2 && at[2] >= 1 && at[2] <= 2;
    }
    if (!isMiddle)
    {
      rest.corners.insert(rest.corners.end(),
        right.corners.begin() + static_cast<std::ptrdiff_t>(c),
        right.corners.begin() + static_cast<std::ptrdiff_t>(c + 4));
    }
  }
  rest = disjointUnion(rest, turnedCube, { 0, 1, 1 });
  const std::int64_t own = unmatchedOf(rest);
  EXPECT_GT(own, 0); // around the cube
  EXPECT_EQ(unmatchedOf(disjointUnion(left, rest, { 1, 0, 0 })), own + 4);
  EXPECT_EQ(unmatchedOf(disjointUnion(left, rest, { 1 + 1e-6, 0, 0 }), 1e-5), own + 4);
}

} // namespace smg::testing
