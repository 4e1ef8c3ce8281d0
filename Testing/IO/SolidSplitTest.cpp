// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/SolidSplit.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

namespace smg::testing
{
namespace
{

using Point = std::array<double, 3>;
using Corners = std::vector<std::int64_t>;

/** Points, and solids with their corners in VTK's order. */
struct SolidMesh
{
  std::vector<Point> points;
  std::vector<Corners> solids;
};

double volume(const std::vector<Point>& points, const std::array<std::int64_t, 4>& tetrahedron)
{
  std::array<Point, 3> e{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      e[k][axis] =
        points[std::size_t(tetrahedron[k + 1])][axis] - points[std::size_t(tetrahedron[0])][axis];
    }
  }
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
           e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6;
}

const SolidMesh Hexahedron{ { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
                              { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } },
  { { 0, 1, 2, 3, 4, 5, 6, 7 } } };
/** VTK's wedge: its first triangle faces out, downwards here. */
const SolidMesh Wedge{ { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 1 },
                         { 1, 0, 1 } },
  { { 0, 1, 2, 3, 4, 5 } } };
const SolidMesh Pyramid{ { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.5, 0.5, 1 } },
  { { 0, 1, 2, 3, 4 } } };

/** All numberings of the corners give positive tetrahedra that fill the solid. */
void expectFilled(const SolidMesh& mesh, std::size_t tetrahedra, double expected)
{
  const std::size_t corners = mesh.points.size();
  Corners numbers(corners);
  std::iota(numbers.begin(), numbers.end(), 0);
  do
  {
    std::vector<Point> points(corners);
    for (std::size_t k = 0; k < corners; ++k)
    {
      points[std::size_t(numbers[k])] = mesh.points[k];
    }
    const TetrahedraOfSolid split = splitSolid(numbers);
    EXPECT_EQ(split.all().size(), tetrahedra);
    double sum = 0;
    for (const auto& tetrahedron : split.all())
    {
      const double part = volume(points, tetrahedron);
      ASSERT_GT(part, 1e-3);
      sum += part;
    }
    ASSERT_NEAR(sum, expected, 1e-14);
  } while (std::ranges::next_permutation(numbers).found);
}

/** A lattice of n^3 cubes, kept as hexahedra, split into six pyramids, or, column by column, into
 * pairs of wedges. */
class Lattice
{
public:
  Lattice(int n, std::uint64_t seed)
    : N(n)
    , Generator(seed)
  {
    for (int i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i)
    {
      this->Mesh.points.push_back(
        { double(i % (n + 1)), double(i / (n + 1) % (n + 1)), double(i / ((n + 1) * (n + 1))) });
    }
    for (int column = 0; column < n * n; ++column)
    {
      const bool wedges = this->Generator.below(3) == 0;
      for (int z = 0; z < n; ++z)
      {
        this->addCube(column % n, column / n, z, wedges);
      }
    }
    this->shuffle();
  }

  const SolidMesh& mesh() const { return this->Mesh; }

private:
  std::int64_t point(int x, int y, int z) const
  {
    return x + (this->N + 1) * (y + std::int64_t(this->N + 1) * z);
  }

  void addCube(int x, int y, int z, bool wedges)
  {
    Corners c;
    for (const Point& corner : Hexahedron.points)
    {
      c.push_back(this->point(x + int(corner[0]), y + int(corner[1]), z + int(corner[2])));
    }
    if (wedges)
    {
      this->Mesh.solids.push_back({ c[0], c[2], c[1], c[4], c[6], c[5] });
      this->Mesh.solids.push_back({ c[0], c[3], c[2], c[4], c[7], c[6] });
    }
    else if (this->Generator.below(2) == 0)
    {
      this->Mesh.solids.push_back(c);
    }
    else
    {
      // Bases that are counterclockwise as seen from the middle of the cube.
      constexpr int bases[6][4] = { { 0, 1, 2, 3 }, { 4, 7, 6, 5 }, { 0, 4, 5, 1 }, { 1, 5, 6, 2 },
        { 2, 6, 7, 3 }, { 3, 7, 4, 0 } };
      this->Mesh.points.push_back({ x + 0.5, y + 0.5, z + 0.5 });
      for (const auto& b : bases)
      {
        this->Mesh.solids.push_back({ c[std::size_t(b[0])], c[std::size_t(b[1])],
          c[std::size_t(b[2])], c[std::size_t(b[3])], std::ssize(this->Mesh.points) - 1 });
      }
    }
  }

  void shuffle()
  {
    const std::size_t count = this->Mesh.points.size();
    std::vector<std::int64_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    for (std::size_t i = count; i > 1; --i)
    {
      std::swap(numbers[i - 1], numbers[std::size_t(this->Generator.below(std::int64_t(i)))]);
    }
    std::vector<Point> points(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      points[std::size_t(numbers[i])] = this->Mesh.points[i];
    }
    this->Mesh.points = points;
    for (Corners& solid : this->Mesh.solids)
    {
      std::ranges::transform(
        solid, solid.begin(), [&numbers](std::int64_t i) { return numbers[std::size_t(i)]; });
    }
  }

  int N;
  Random Generator;
  SolidMesh Mesh;
};

bool isOnSurface(const std::vector<Point>& points, const std::array<std::int64_t, 3>& face, int n)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double side : { 0.0, double(n) })
    {
      if (std::ranges::all_of(
            face, [&](std::int64_t corner) { return points[std::size_t(corner)][axis] == side; }))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace

TEST(SolidSplit, FillsTheSolidWhateverTheNumbersOfItsCorners)
{
  expectFilled(Hexahedron, 6, 1.0);
  expectFilled(Wedge, 3, 0.5);
  expectFilled(Pyramid, 2, 1.0 / 3);
}

TEST(SolidSplit, NeighboursFitTogether)
{
  constexpr int N = 4;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const Lattice lattice(N, seed);
    const std::vector<Point>& points = lattice.mesh().points;
    double sum = 0;
    std::map<std::array<std::int64_t, 3>, int> faces;
    for (const Corners& solid : lattice.mesh().solids)
    {
      const TetrahedraOfSolid tetrahedra = splitSolid(solid);
      for (const auto& tetrahedron : tetrahedra.all())
      {
        const double part = volume(points, tetrahedron);
        ASSERT_GT(part, 1e-3);
        sum += part;
        for (std::size_t left = 0; left < 4; ++left)
        {
          std::array<std::int64_t, 3> face{ tetrahedron[(left + 1) % 4],
            tetrahedron[(left + 2) % 4], tetrahedron[(left + 3) % 4] };
          std::ranges::sort(face);
          ++faces[face];
        }
      }
    }
    EXPECT_NEAR(sum, N * N * N, 1e-12);
    for (const auto& [face, count] : faces)
    {
      ASSERT_EQ(count, isOnSurface(points, face, N) ? 1 : 2) << "seed " << seed;
    }
  }
}

TEST(SolidSplit, CollapsedSolidsAreFilledToo)
{
  // A hexahedron with collapsed edges becomes a wedge, then a pyramid, then a tetrahedron.
  const std::vector<std::pair<Corners, double>> collapsed{ { { 0, 1, 2, 2, 4, 5, 6, 6 }, 0.5 },
    { { 0, 1, 2, 3, 4, 4, 4, 4 }, 1.0 / 3 }, { { 0, 1, 2, 2, 4, 4, 4, 4 }, 1.0 / 6 },
    { { 0, 0, 0, 0, 0, 0, 0, 0 }, 0.0 } };
  for (const auto& [corners, expected] : collapsed)
  {
    double sum = 0;
    const TetrahedraOfSolid tetrahedra = splitSolid(corners);
    for (const auto& tetrahedron : tetrahedra.all())
    {
      const double part = volume(Hexahedron.points, tetrahedron);
      EXPECT_GT(part, 1e-3);
      sum += part;
    }
    EXPECT_NEAR(sum, expected, 1e-14);
  }
}

} // namespace smg::testing
