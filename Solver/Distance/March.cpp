// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distance/March.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace smg
{

namespace
{

constexpr double Infinite = std::numeric_limits<double>::infinity();

} // namespace

int March::run(int maxPasses, Progress& progress, double begin)
{
  int passes = 0;
  for (; passes<maxPasses&& this->unsettled()> 0; ++passes)
  {
    // How many passes are to come is not known.
    const double end = begin + 0.5 * (1 - begin);
    this->pass(passes % 2 == 0, progress, begin, end);
    begin = end;
  }
  this->Window.flush();
  return passes;
}

std::int64_t March::unsettled() const
{
  std::int64_t dirty = 0;
  for (const ChunkedMesh::Chunk& chunk : this->Window.mesh().chunks)
  {
    dirty += chunk.dirty;
  }
  return dirty;
}

void March::pass(bool forwards, Progress& progress, double begin, double end)
{
  ChunkedMesh& mesh = this->Window.mesh();
  const std::int64_t shown = std::min(ChunkPlan::WindowChunks, mesh.count());
  const std::int64_t positions = mesh.count() - shown + 1;
  for (std::int64_t p = 0; p < positions; ++p)
  {
    const std::int64_t first = forwards ? p : positions - 1 - p;
    const std::int64_t last = first + shown - 1;
    const auto isDirty = [](const ChunkedMesh::Chunk& chunk) { return chunk.dirty > 0; };
    if (std::any_of(mesh.chunks.begin() + first, mesh.chunks.begin() + last + 1, isDirty))
    {
      this->Window.show(first, last);
      const bool triangles = mesh.plan.cellType == CellType::Triangle;
      if (mesh.curved)
      {
        triangles ? this->settle<3, Front::OfCurves>(first, last)
                  : this->settle<4, Front::OfCurves>(first, last);
      }
      else
      {
        triangles ? this->settle<3, Front::OfPoints>(first, last)
                  : this->settle<4, Front::OfPoints>(first, last);
      }
    }
    progress.update(
      begin + (end - begin) * static_cast<double>(p + 1) / static_cast<double>(positions));
  }
}

template <int Corners, Front Kind>
void March::settle(std::int64_t first, std::int64_t last)
{
  ChunkedMesh& mesh = this->Window.mesh();
  std::uint8_t* flags = this->Window.flags();
  const double* distances = this->Window.distance();
  for (std::int64_t chunk = first; chunk <= last; ++chunk)
  {
    const std::uint32_t begin = this->Window.placeOf(chunk);
    const auto end = begin + static_cast<std::uint32_t>(mesh.countOf(chunk));
    for (std::uint32_t v = begin; v < end && mesh.chunks[std::size_t(chunk)].dirty > 0; ++v)
    {
      if ((flags[v] & Dirty) != 0)
      {
        this->Queue.put(v, distances[v]);
      }
    }
  }
  while (!this->Queue.isEmpty())
  {
    const std::uint32_t v = this->Queue.take();
    const bool hasAll = this->Window.hasAllCellsOf(v);
    if (!hasAll && distances[v] == 0)
    {
      // The cells of a source with other sources come first: whether it is the end of a curve.
      continue;
    }
    flags[v] |= Changed;
    if (hasAll)
    {
      flags[v] &= static_cast<std::uint8_t>(~Dirty);
    }
    this->Window.forCellsOf<Corners>(v,
      [&](const std::uint32_t* cell)
      {
        // Without a branch, since which corner is v cannot be predicted; the last one is not used.
        std::array<std::uint32_t, Corners> others;
        std::size_t k = 0;
        for (int c = 0; c < Corners; ++c)
        {
          others[k] = cell[c];
          k += cell[c] != v ? 1 : 0;
        }
        this->passOn<Kind>(v, others);
      });
  }
  for (std::int64_t chunk = first; chunk <= last; ++chunk)
  {
    const std::uint8_t* begin = flags + this->Window.placeOf(chunk);
    mesh.chunks[std::size_t(chunk)].dirty = std::count_if(
      begin, begin + mesh.countOf(chunk), [](std::uint8_t bits) { return (bits & Dirty) != 0; });
  }
}

template <Front Kind>
FrontCorner March::corner(std::uint32_t vertex) const
{
  return { this->Window.point(vertex), this->Window.distance()[vertex],
    Kind == Front::OfCurves ? this->Window.curvature()[vertex] : 0 };
}

void March::offer(std::uint32_t w, const Arrival& arrival, std::uint32_t from)
{
  double& distance = this->Window.distance()[w];
  float* curvature = this->Window.curvature();
  // Of two fronts that arrive at the same time, the flatter one goes ahead.
  const bool isFlatter = curvature && arrival.curvature < 0.5 * curvature[w] &&
                         arrival.distance < distance * (1 + Tolerance);
  if (arrival.distance < distance * (1 - Tolerance) || isFlatter)
  {
    distance = std::min(distance, arrival.distance);
    this->Window.flags()[w] |= Dirty | Changed;
    if (curvature)
    {
      curvature[w] = static_cast<float>(arrival.curvature);
    }
    if (std::int64_t* source = this->Window.source())
    {
      source[w] = source[from];
    }
    this->Queue.put(w, distance);
  }
}

/** Offers paths from v, and across its edges, to the other two corners of a triangle. */
template <Front Kind>
void March::passOn(std::uint32_t v, const std::array<std::uint32_t, 3>& others)
{
  const FrontCorner from = this->corner<Kind>(v);
  const Vector e[2] = { difference(this->Window.point(others[0]), from.point),
    difference(this->Window.point(others[1]), from.point) };
  const double square[2] = { dot(e[0], e[0]), dot(e[1], e[1]) };
  const double product = dot(e[0], e[1]);
  for (int k = 0; k < 2; ++k)
  {
    const std::uint32_t w = others[k], b = others[1 - k];
    const FrontCorner passed = this->corner<Kind>(b);
    if (this->Window.distance()[w] <= std::min(from.distance, passed.distance))
    {
      continue;
    }
    if (passed.distance < Infinite)
    {
      const Arrival across = acrossEdge<Kind>({ square[1 - k], product, square[k] }, from, passed);
      if (across.distance < Infinite)
      {
        // No longer than the paths along the edges.
        this->offer(w, across, across.weight[0] > 0.5 ? b : v);
        continue;
      }
    }
    this->offer(w, fromCorner<Kind>(from, std::sqrt(square[k])), v);
  }
}

/** The same for the other three corners of a tetrahedron. */
template <Front Kind>
void March::passOn(std::uint32_t v, const std::array<std::uint32_t, 4>& others)
{
  const FrontCorner from = this->corner<Kind>(v);
  Vector e[3];
  double product[3][3];
  for (int i = 0; i < 3; ++i)
  {
    e[i] = difference(this->Window.point(others[i]), from.point);
    for (int j = 0; j <= i; ++j)
    {
      product[i][j] = product[j][i] = dot(e[i], e[j]);
    }
  }
  for (int k = 0; k < 3; ++k)
  {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const std::uint32_t w = others[k];
    const FrontCorner b = this->corner<Kind>(others[i]), c = this->corner<Kind>(others[j]);
    const double before = this->Window.distance()[w];
    if (before <= std::min({ from.distance, b.distance, c.distance }))
    {
      continue;
    }
    if (std::max(b.distance, c.distance) < Infinite)
    {
      const Arrival across = acrossFace<Kind>({ product[i][i], product[i][j], product[j][j],
                                                product[k][i], product[k][j], product[k][k] },
        from, b, c);
      if (across.distance < Infinite)
      {
        const double rest = 1 - across.weight[0] - across.weight[1];
        const bool isFirst = rest >= std::max(across.weight[0], across.weight[1]);
        this->offer(w, across,
          isFirst                                ? v
          : across.weight[0] >= across.weight[1] ? others[i]
                                                 : others[j]);
        continue;
      }
    }
    bool crosses = false;
    for (const int n : { i, j })
    {
      const FrontCorner& passed = n == i ? b : c;
      if (passed.distance < Infinite)
      {
        const Arrival across =
          acrossEdge<Kind>({ product[n][n], product[k][n], product[k][k] }, from, passed);
        crosses = crosses || across.distance < Infinite;
        this->offer(w, across, across.weight[0] > 0.5 ? others[n] : v);
      }
    }
    if (!crosses)
    {
      this->offer(w, fromCorner<Kind>(from, std::sqrt(product[k][k])), v);
    }
  }
}

} // namespace smg
