// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/SplitTriangles.h"

#include "Testing/Benchmarks/RandomOrder.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace smg::benchmark
{
namespace
{

using testing::IndexedTestMesh;
using Weights = std::array<std::int64_t, 3>;

/** A split mesh: its vertices are those of the triangles, then those inside edges, then inside
 * triangles. */
class SplitMesh
{
public:
  SplitMesh(const IndexedTestMesh& triangles, std::int64_t parts)
    : Triangles(triangles)
    , Parts(parts)
    , InTriangle((parts - 1) * (parts - 2) / 2)
  {
    std::unordered_map<std::int64_t, std::int64_t> numbers;
    for (std::int64_t c = 0; c < triangles.cells(); ++c)
    {
      for (int k = 0; k < 3; ++k)
      {
        const auto [a, b] =
          std::minmax({ this->corner(c, (k + 1) % 3), this->corner(c, (k + 2) % 3) });
        const auto [place, isNew] =
          numbers.try_emplace(a * triangles.vertices() + b, std::int64_t(numbers.size()));
        this->Opposite.push_back(place->second);
        if (isNew)
        {
          this->Edges.push_back({ a, b });
        }
      }
    }
    this->FirstInEdges = triangles.vertices();
    this->FirstInTriangles =
      this->FirstInEdges + std::int64_t(this->Edges.size()) * (this->Parts - 1);
  }

  std::int64_t vertices() const
  {
    return this->FirstInTriangles + this->Triangles.cells() * this->InTriangle;
  }
  std::int64_t cells() const { return this->Triangles.cells() * this->Parts * this->Parts; }

  std::array<float, 3> position(std::int64_t vertex) const
  {
    if (vertex < this->FirstInEdges)
    {
      return this->mean({ vertex, 0, 0 }, { this->Parts, 0, 0 });
    }
    if (vertex < this->FirstInTriangles)
    {
      const auto [edge, from] = divided(vertex - this->FirstInEdges, this->Parts - 1);
      const auto [a, b] = this->Edges[std::size_t(edge)];
      return this->mean({ a, b, 0 }, { this->Parts - 1 - from, from + 1, 0 });
    }
    const auto [cell, inside] = divided(vertex - this->FirstInTriangles, this->InTriangle);
    const std::int64_t row = rowOf(inside);
    const std::int64_t third = inside - row * (row + 1) / 2 + 1;
    const std::int64_t second = row + 2 - third;
    return this->mean({ this->corner(cell, 0), this->corner(cell, 1), this->corner(cell, 2) },
      { this->Parts - second - third, second, third });
  }

  /** Row r of a split triangle, from its first corner on, has 2 r + 1 cells. */
  std::array<std::int64_t, 3> cell(std::int64_t number) const
  {
    const auto [cell, inside] = divided(number, this->Parts * this->Parts);
    const auto row = std::int64_t(std::sqrt(double(inside)));
    const auto [k, isUpper] = divided(inside - row * row, 2);
    if (isUpper)
    {
      return { this->vertex(cell, row, k), this->vertex(cell, row + 1, k + 1),
        this->vertex(cell, row, k + 1) };
    }
    return { this->vertex(cell, row, k), this->vertex(cell, row + 1, k),
      this->vertex(cell, row + 1, k + 1) };
  }

private:
  static std::pair<std::int64_t, std::int64_t> divided(std::int64_t a, std::int64_t b)
  {
    return { a / b, a % b };
  }

  /** The r for which r (r + 1) / 2 <= number < (r + 1) (r + 2) / 2. */
  static std::int64_t rowOf(std::int64_t number)
  {
    return std::int64_t((std::sqrt(8.0 * double(number) + 1.0) - 1.0) / 2.0);
  }

  std::int64_t corner(std::int64_t cell, int k) const
  {
    return this->Triangles.corners[std::size_t(3 * cell + k)];
  }

  std::array<float, 3> mean(const Weights& corners, const Weights& weights) const
  {
    std::array<float, 3> position;
    for (std::size_t k = 0; k < 3; ++k)
    {
      double sum = 0.0;
      for (std::size_t c = 0; c < 3; ++c)
      {
        sum += double(weights[c]) * this->Triangles.positions[std::size_t(3 * corners[c]) + k];
      }
      position[k] = float(sum / double(this->Parts));
    }
    return position;
  }

  /** The vertex of a triangle `row` rows from its first corner, `k` from its second side. */
  std::int64_t vertex(std::int64_t cell, std::int64_t row, std::int64_t k) const
  {
    const Weights weights{ this->Parts - row, row - k, k };
    const int zeros = int(std::ranges::count(weights, 0));
    if (zeros == 2)
    {
      return this->corner(cell, int(std::ranges::max_element(weights) - weights.begin()));
    }
    if (zeros == 1)
    {
      const int opposite = int(std::ranges::find(weights, 0) - weights.begin());
      const std::int64_t edge = this->Opposite[std::size_t(3 * cell + opposite)];
      const int next = (opposite + 1) % 3;
      const bool isForward = this->corner(cell, next) == this->Edges[std::size_t(edge)].first;
      const std::int64_t from = weights[std::size_t(isForward ? (opposite + 2) % 3 : next)];
      return this->FirstInEdges + edge * (this->Parts - 1) + from - 1;
    }
    const std::int64_t line = row - 2;
    return this->FirstInTriangles + cell * this->InTriangle + line * (line + 1) / 2 + k - 1;
  }

  const IndexedTestMesh& Triangles;
  std::int64_t Parts, InTriangle;
  std::vector<std::pair<std::int64_t, std::int64_t>> Edges; ///< the smaller vertex first
  std::vector<std::int64_t> Opposite; ///< per corner of a triangle: the edge of the other two
  std::int64_t FirstInEdges = 0, FirstInTriangles = 0;
};

template <class T>
void write(std::ofstream& file, const T& value)
{
  file.write(reinterpret_cast<const char*>(&value), sizeof(T));
}

} // namespace

void writeSplit(const IndexedTestMesh& triangles, std::int64_t parts,
  const std::filesystem::path& path, std::uint64_t seed)
{
  static_assert(std::endian::native == std::endian::little);
  const SplitMesh mesh(triangles, parts);
  if (std::max(mesh.vertices(), mesh.cells()) > std::numeric_limits<std::int32_t>::max())
  {
    throw Error(path.string() + ": the mesh has more than 2^31 - 1 vertices or cells.");
  }
  const RandomOrder vertices(std::uint64_t(mesh.vertices()), seed);
  const RandomOrder cells(std::uint64_t(mesh.cells()), seed + 1);
  std::ofstream file(path, std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.vertices()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.cells()
       << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    write(file, mesh.position(std::int64_t(vertices.item(std::uint64_t(v)))));
  }
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    write(file, std::uint8_t(3));
    for (const std::int64_t corner : mesh.cell(std::int64_t(cells.item(std::uint64_t(c)))))
    {
      write(file, std::int32_t(vertices.place(std::uint64_t(corner))));
    }
  }
  if (!file.flush())
  {
    throw Error(path.string() + ": cannot be written.");
  }
}

} // namespace smg::benchmark
