// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/FinerTetrahedra.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace smg::benchmark
{
namespace
{

using Index = std::int64_t;

/** Numbers the midpoints of edges after the vertices of a mesh. */
class Midpoints
{
public:
  Midpoints(std::vector<double>& positions, std::size_t edges)
    : Positions(positions)
    , Vertices(static_cast<Index>(positions.size() / 3))
  {
    this->Numbers.reserve(edges);
  }

  Index operator()(Index a, Index b)
  {
    const auto next = static_cast<Index>(this->Positions.size() / 3);
    const auto [place, isNew] =
      this->Numbers.try_emplace(std::min(a, b) * this->Vertices + std::max(a, b), next);
    for (Index k = 0; isNew && k < 3; ++k)
    {
      this->Positions.push_back(0.5 * (this->at(a, k) + this->at(b, k)));
    }
    return place->second;
  }

  double squaredDistance(Index a, Index b) const
  {
    double sum = 0;
    for (Index k = 0; k < 3; ++k)
    {
      const double side = this->at(a, k) - this->at(b, k);
      sum += side * side;
    }
    return sum;
  }

private:
  double at(Index vertex, Index k) const
  {
    return this->Positions[static_cast<std::size_t>(3 * vertex + k)];
  }

  std::vector<double>& Positions;
  Index Vertices;
  std::unordered_map<Index, Index> Numbers;
};

/** A diagonal of the inner octahedron and the four other midpoints around it: the diagonal and two
 * consecutive midpoints form a tetrahedron with the orientation of the whole one. */
using Diagonal = std::array<Index, 6>;

} // namespace

testing::IndexedTestMesh finerTetrahedra(const testing::IndexedTestMesh& tetrahedra)
{
  testing::IndexedTestMesh fine = tetrahedra;
  fine.corners.clear();
  fine.corners.reserve(8 * tetrahedra.corners.size());
  // A tetrahedral mesh has somewhat more edges than cells.
  Midpoints midpoint(fine.positions, tetrahedra.corners.size() / 3);
  for (std::size_t c = 0; c < tetrahedra.corners.size(); c += 4)
  {
    const Index* v = tetrahedra.corners.data() + c;
    const Index m01 = midpoint(v[0], v[1]), m02 = midpoint(v[0], v[2]), m03 = midpoint(v[0], v[3]);
    const Index m12 = midpoint(v[1], v[2]), m13 = midpoint(v[1], v[3]), m23 = midpoint(v[2], v[3]);
    fine.corners.insert(fine.corners.end(),
      { v[0], m01, m02, m03, m01, v[1], m12, m13, m02, m12, v[2], m23, m03, m13, m23, v[3] });
    const std::array<Diagonal, 3> diagonals = { Diagonal{ m01, m23, m02, m03, m13, m12 },
      Diagonal{ m02, m13, m01, m12, m23, m03 }, Diagonal{ m03, m12, m01, m02, m23, m13 } };
    const Diagonal& d = std::ranges::min(
      diagonals, {}, [&](const Diagonal& x) { return midpoint.squaredDistance(x[0], x[1]); });
    for (std::size_t k = 0; k < 4; ++k)
    {
      fine.corners.insert(fine.corners.end(), { d[0], d[1], d[2 + k], d[2 + (k + 1) % 4] });
    }
  }
  return fine;
}

} // namespace smg::benchmark
