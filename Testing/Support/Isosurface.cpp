// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/Isosurface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

/** The six tetrahedra of a cube, paths along its edges from corner 0 to corner 7. */
constexpr std::array<std::array<int, 4>, 6> Tetrahedra{ { { 0, 1, 3, 7 }, { 0, 3, 2, 7 },
  { 0, 2, 6, 7 }, { 0, 6, 4, 7 }, { 0, 4, 5, 7 }, { 0, 5, 1, 7 } } };

/** Samples of a function in a cube, and the surface where it is 0. */
class MarchedTetrahedra
{
public:
  MarchedTetrahedra(int n, std::vector<double> samples)
    : N(n)
    , Samples(std::move(samples))
  {
  }

  IndexedTestMesh surface()
  {
    for (int k = 0; k + 1 < this->N; ++k)
    {
      for (int j = 0; j + 1 < this->N; ++j)
      {
        for (int i = 0; i + 1 < this->N; ++i)
        {
          this->addCube(i, j, k);
        }
      }
    }
    return std::move(this->Mesh);
  }

private:
  void addCube(int i, int j, int k)
  {
    for (const auto& corners : Tetrahedra)
    {
      std::array<std::int64_t, 4> t{};
      for (std::size_t c = 0; c < 4; ++c)
      {
        t[c] = i + (corners[c] & 1) +
               this->N * (j + (corners[c] >> 1 & 1) +
                           static_cast<std::int64_t>(this->N) * (k + (corners[c] >> 2)));
      }
      this->addTetrahedron(t);
    }
  }

  bool isInside(std::int64_t sample) const
  {
    return this->Samples[static_cast<std::size_t>(sample)] < 0.0;
  }

  /** The corners inside first, by an even permutation, so that triangles are wound outwards. */
  void addTetrahedron(std::array<std::int64_t, 4> t)
  {
    std::size_t inside = 0;
    bool isOdd = false;
    for (std::size_t c = 0; c < 4; ++c)
    {
      if (this->isInside(t[c]))
      {
        for (std::size_t at = c; at > inside; --at)
        {
          std::swap(t[at], t[at - 1]);
          isOdd = !isOdd;
        }
        ++inside;
      }
    }
    if (inside == 0 || inside == 4)
    {
      return;
    }
    if (isOdd)
    {
      inside == 1 ? std::swap(t[2], t[3]) : std::swap(t[0], t[1]);
    }
    const auto cut = [&](std::size_t a, std::size_t b) { return this->vertex(t[a], t[b]); };
    if (inside == 1)
    {
      this->add(cut(0, 1), cut(0, 2), cut(0, 3));
    }
    else if (inside == 3)
    {
      this->add(cut(0, 3), cut(1, 3), cut(2, 3));
    }
    else
    {
      const std::int64_t a = cut(0, 2), b = cut(0, 3), c = cut(1, 3), d = cut(1, 2);
      this->add(a, b, c);
      this->add(a, c, d);
    }
  }

  void add(std::int64_t a, std::int64_t b, std::int64_t c)
  {
    this->Mesh.corners.insert(this->Mesh.corners.end(), { a, b, c });
  }

  /** On the edge from a sample inside to one outside. */
  std::int64_t vertex(std::int64_t a, std::int64_t b)
  {
    const auto key = static_cast<std::uint64_t>(std::min(a, b)) << 32U |
                     static_cast<std::uint64_t>(std::max(a, b));
    const auto [entry, isNew] = this->Vertices.try_emplace(key, this->Mesh.vertices());
    if (isNew)
    {
      const double inside = this->Samples[static_cast<std::size_t>(a)];
      const double share = inside / (inside - this->Samples[static_cast<std::size_t>(b)]);
      std::array<std::int64_t, 3> from = this->place(a), to = this->place(b);
      for (std::size_t d = 0; d < 3; ++d)
      {
        const auto start = static_cast<double>(from[d]);
        this->Mesh.positions.push_back(
          (start + share * static_cast<double>(to[d] - from[d])) / (this->N - 1));
      }
    }
    return entry->second;
  }

  std::array<std::int64_t, 3> place(std::int64_t sample) const
  {
    return { sample % this->N, sample / this->N % this->N, sample / this->N / this->N };
  }

  std::int64_t N;
  std::vector<double> Samples;
  IndexedTestMesh Mesh;
  std::unordered_map<std::uint64_t, std::int64_t> Vertices;
};

} // namespace

IndexedTestMesh noisyGyroid(int n, double noise, std::uint64_t seed)
{
  Random random(seed);
  std::vector<double> samples;
  samples.reserve(static_cast<std::size_t>(n) * n * n);
  const auto at = [&](int i) { return 6 * std::numbers::pi * i / (n - 1); };
  for (int k = 0; k < n; ++k)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        samples.push_back(std::sin(at(i)) * std::cos(at(j)) + std::sin(at(j)) * std::cos(at(k)) +
                          std::sin(at(k)) * std::cos(at(i)) + random.uniform(-noise, noise));
      }
    }
  }
  return MarchedTetrahedra(n, std::move(samples)).surface();
}

} // namespace smg::testing
