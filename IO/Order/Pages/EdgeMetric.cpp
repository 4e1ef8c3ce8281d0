// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/EdgeMetric.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace smg
{

namespace
{

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

/** The edges of the cells without the longest ones, divided by the longest of the others. */
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

/** The range of most of the sample along a direction. */
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

EdgeMetric::EdgeMetric(const CellSample& sample)
{
  const std::vector<std::size_t> places = sample.differentVertices();
  if (places.empty())
  {
    return;
  }
  Matrix3d covariance = Matrix3d::Zero();
  for (const Vector3d& edge : scaledEdges(sample))
  {
    covariance += edge * edge.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(covariance);
  const Vector3d deviation = eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  const double largest = deviation.maxCoeff();
  // Extents in units of about the length of edges.
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
