// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/EdgeMetric.h"

#include "IO/Order/Pages/RankedVertices.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

// Keys of vertices along a Hilbert curve, in a metric in which edges are about equally long in all
// directions. In the plain box of the coordinates, thin triangles, layers and a few distant points
// would make the curve separate neighbours. The metric comes from a sample of some thousand cells;
// a fixed seed and the positions in the file determine it, so the same file has the same keys.

namespace smg
{
namespace
{

/** The numbers of the sampled cells, ascending: one from each of equal parts of the file. */
std::vector<std::int64_t> chooseCells(std::int64_t cells)
{
  const std::int64_t count = std::min(cells, CellSample::Most);
  std::vector<std::int64_t> chosen(static_cast<std::size_t>(count));
  // Not at equal strides, which could coincide with the rows of a grid.
  std::mt19937_64 random(1);
  for (std::int64_t i = 0; i < count; ++i)
  {
    const std::int64_t begin = cells * i / count, end = cells * (i + 1) / count;
    chosen[std::size_t(i)] =
      begin + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(end - begin));
  }
  return chosen;
}

template <class Real>
void fillPositions(const RawMesh& mesh, CellSample& sample)
{
  // The corners by ascending vertex, so that one pass over the file of the vertices finds all
  // positions.
  std::vector<std::uint32_t> places(sample.vertices.size());
  std::iota(places.begin(), places.end(), 0u);
  std::sort(places.begin(), places.end(),
    [&sample](std::uint32_t a, std::uint32_t b)
    { return sample.vertices[a] < sample.vertices[b]; });
  sample.positions.resize(places.size());
  auto next = places.begin();
  forEachVertex<Real>(mesh,
    [&](std::uint32_t vertex, const Real* position)
    {
      for (; next != places.end() && sample.vertices[*next] == vertex; ++next)
      {
        std::copy_n(position, 3, sample.positions[*next].begin());
      }
    });
}

/** Rotates three bits left by `count` positions. */
unsigned turned(unsigned bits, int count)
{
  count %= 3;
  return ((bits << count) | (bits >> (3 - count))) & 7;
}

struct Step
{
  unsigned digit; ///< the position of the octant on the curve
  unsigned state; ///< in the octant
};

/** One level of the curve (C. Hamilton, Compact Hilbert Indices, 2006): where an octant is on the
 * curve, and the state in it. A state is the direction of the curve times eight plus the corner at
 * which it enters. */
Step step(unsigned state, unsigned octant)
{
  const int direction = static_cast<int>(state / 8);
  const unsigned entry = state % 8;
  const unsigned gray = turned(octant ^ entry, 2 - direction);
  const unsigned digit = gray ^ gray >> 1 ^ gray >> 2;
  if (digit == 0)
  {
    return { 0, static_cast<unsigned>((direction + 1) % 3) * 8 + entry };
  }
  const unsigned even = (digit - 1) / 2 * 2;
  const int turn = std::countr_one(digit % 2 == 0 ? digit - 1 : digit) % 3;
  const unsigned nextEntry = entry ^ turned(even ^ even >> 1, direction + 1);
  return { digit, static_cast<unsigned>((direction + turn + 1) % 3) * 8 + nextEntry };
}

using Eigen::Matrix3d;
using Eigen::Vector3d;

/** The shares of edges and of vertices that count as outliers, at one end. */
constexpr double LongestEdges = 0.05, OuterVertices = 0.002;
/** The box exceeds the sample by this share of its extent at both ends. */
constexpr double Margin = 0.06;
/** An axis is flat if edges are shorter along it than along the longest by this factor. */
constexpr double Flat = 1e-6;

Vector3d vectorOf(const std::array<double, 3>& position)
{
  return { position[0], position[1], position[2] };
}

/** The edges of the sampled cells without the longest ones, which may be errors, divided by the
 * longest of the others, so that their squares neither overflow nor vanish. */
std::vector<Vector3d> scaledEdges(const CellSample& sample)
{
  std::vector<Vector3d> edges;
  edges.reserve(sample.cells() * sample.corners * (sample.corners - 1) / 2);
  for (std::size_t cell = 0; cell < sample.cells(); ++cell)
  {
    const auto* corners = sample.positions.data() + cell * sample.corners;
    for (std::size_t a = 1; a < sample.corners; ++a)
    {
      for (std::size_t b = 0; b < a; ++b)
      {
        edges.push_back(vectorOf(corners[a]) - vectorOf(corners[b]));
      }
    }
  }
  // The largest component instead of the length, whose square may overflow.
  const auto size = [](const Vector3d& edge) { return edge.lpNorm<Eigen::Infinity>(); };
  const auto kept = static_cast<std::size_t>(double(edges.size()) * (1 - LongestEdges));
  std::ranges::nth_element(edges, edges.begin() + std::ptrdiff_t(kept), {}, size);
  edges.resize(kept);
  double largest = 0;
  for (const Vector3d& edge : edges)
  {
    largest = std::max(largest, size(edge));
  }
  if (!(largest > 0) || !std::isfinite(largest))
  {
    return {};
  }
  for (Vector3d& edge : edges)
  {
    edge /= largest;
  }
  return edges;
}

struct Range
{
  double low, extent;
};

/** The range of the sample along a direction, without the outermost vertices, and with a margin:
 * what lies outside is put at the border of the curve's cube. */
Range rangeAlong(
  const Vector3d& direction, const CellSample& sample, const std::vector<std::size_t>& places)
{
  std::vector<double> values;
  values.reserve(places.size());
  for (const std::size_t place : places)
  {
    const double value = direction.dot(vectorOf(sample.positions[place]));
    values.push_back(std::isfinite(value) ? value : 0);
  }
  std::ranges::sort(values);
  const auto outer = static_cast<std::size_t>(double(values.size()) * OuterVertices);
  const double low = values[outer], extent = values[values.size() - 1 - outer] - low;
  return { low - Margin * extent, extent * (1 + 2 * Margin) };
}

} // namespace

std::vector<std::size_t> CellSample::differentVertices() const
{
  std::vector<std::size_t> places(this->cells());
  for (std::size_t cell = 0; cell < places.size(); ++cell)
  {
    places[cell] = cell * this->corners + cell % this->corners;
  }
  // The corner changes from cell to cell, so that no place within cells is preferred. Then
  // repetitions go.
  const auto vertexAt = [this](std::size_t place) { return this->vertices[place]; };
  std::ranges::sort(places, {}, vertexAt);
  const auto repeated = std::unique(places.begin(), places.end(),
    [&](std::size_t a, std::size_t b) { return vertexAt(a) == vertexAt(b); });
  places.erase(repeated, places.end());
  return places;
}

CellSample sampleCells(const RawMesh& mesh)
{
  CellSample sample;
  sample.corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  const std::vector<std::int64_t> chosen = chooseCells(mesh.cells);
  // One pass over the cells; the chosen ones ascend as well.
  const auto corners = static_cast<std::int64_t>(sample.corners);
  std::int64_t first = 0;
  auto next = chosen.begin();
  forEachStretch(mesh.corners, sample.corners,
    [&](std::span<const std::uint32_t> stretch)
    {
      const std::int64_t end = first + static_cast<std::int64_t>(stretch.size()) / corners;
      for (; next != chosen.end() && *next < end; ++next)
      {
        const auto cell =
          stretch.subspan(static_cast<std::size_t>((*next - first) * corners), sample.corners);
        sample.vertices.insert(sample.vertices.end(), cell.begin(), cell.end());
      }
      first = end;
    });
  mesh.doublePositions ? fillPositions<double>(mesh, sample) : fillPositions<float>(mesh, sample);
  return sample;
}

/** Two levels of the curve for each state and pair of bits of the coordinates: halves the steps of
 * a key. */
HilbertCurve::HilbertCurve()
{
  for (unsigned state = 0; state < States; ++state)
  {
    for (unsigned place = 0; place < 64; ++place)
    {
      const unsigned coarse = (place >> 1 & 1) | (place >> 3 & 1) << 1 | (place >> 5 & 1) << 2;
      const unsigned fine = (place & 1) | (place >> 2 & 1) << 1 | (place >> 4 & 1) << 2;
      const Step first = step(state, coarse);
      const Step second = step(first.state, fine);
      this->Steps[state * 64 + place] =
        static_cast<std::uint16_t>(second.state * 64 + first.digit * 8 + second.digit);
    }
  }
}

EdgeMetric::EdgeMetric(const CellSample& sample)
{
  const std::vector<std::size_t> places = sample.differentVertices();
  if (places.empty())
  {
    return;
  }
  // The principal directions of the edges, and the length of edges along each.
  Matrix3d covariance = Matrix3d::Zero();
  for (const Vector3d& edge : scaledEdges(sample))
  {
    covariance += edge * edge.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(covariance);
  const Vector3d deviation = eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  const double largest = deviation.maxCoeff();
  // Extents of the mesh in units of about the length of its edges.
  std::array<Range, 3> ranges;
  std::array<double, 3> extents{};
  double most = 0;
  for (int k = 0; k < 3; ++k)
  {
    ranges[std::size_t(k)] = rangeAlong(eigen.eigenvectors().col(k), sample, places);
    if (deviation[k] > Flat * largest)
    {
      extents[std::size_t(k)] = ranges[std::size_t(k)].extent / deviation[k];
      most = std::max(most, extents[std::size_t(k)]);
    }
  }
  // One scale for all three axes, so that cells of the curve have edges of equal length in that
  // unit. A flat direction gets the largest extent: whatever differs along it, as layers do, is
  // kept apart.
  most = most > 0 ? most : 1;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double extent = deviation[Eigen::Index(k)] > Flat * largest ? extents[k] : most;
    const double scale = extent / most * HilbertCurve::Largest / ranges[k].extent;
    if (ranges[k].extent > 0 && std::isfinite(scale))
    {
      const Vector3d direction = scale * eigen.eigenvectors().col(Eigen::Index(k));
      this->Axes[k] = { { direction[0], direction[1], direction[2] }, scale * ranges[k].low };
    }
  }
}

bool numbersAreMoreLocal(
  const CellSample& sample, const EdgeMetric& metric, std::int64_t vertices, double tolerance)
{
  std::vector<std::uint64_t> keys;
  for (const std::size_t place : sample.differentVertices())
  {
    keys.push_back(metric.key(sample.positions[place].data()));
  }
  std::ranges::sort(keys);
  if (keys.empty())
  {
    return false;
  }
  // A rank is estimated by the place among the keys of the sample, each of which stands for as many
  // vertices; the tolerance grows by the error of that.
  const double perKey = double(vertices) / double(keys.size());
  const double within = tolerance + 3 * perKey;
  const auto rank = [&](std::size_t place)
  {
    const auto at = std::ranges::lower_bound(keys, metric.key(sample.positions[place].data()));
    return double(at - keys.begin()) * perKey;
  };
  std::size_t edges = 0, localKeys = 0, localNumbers = 0;
  for (std::size_t first = 0; first < sample.vertices.size(); first += sample.corners)
  {
    for (std::size_t other = first + 1; other < first + sample.corners; ++other)
    {
      ++edges;
      localKeys += std::abs(rank(first) - rank(other)) < within;
      localNumbers +=
        std::abs(double(sample.vertices[first]) - double(sample.vertices[other])) < within;
    }
  }
  // If all points coincide, equal positions carry no information.
  const double byKeys = keys.front() == keys.back() ? 0.0 : double(localKeys);
  return double(localNumbers) > byKeys + 0.05 * double(edges);
}

} // namespace smg
