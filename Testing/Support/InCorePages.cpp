// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/InCorePages.h"

#include "IO/External/Relabelling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace smg::testing
{
namespace
{

constexpr std::size_t Samples = 16384;

template <class Real>
ReadOrder readOrderAs(const OrderedVertices& order)
{
  ReadOrder read;
  BucketFile::Reader reader(order.records);
  for (OrderedVertex<Real> vertex; reader.get(vertex);)
  {
    read.ids.push_back(vertex.id);
    read.reaches.push_back(vertex.reach);
    read.positions.insert(
      read.positions.end(), { vertex.position[0], vertex.position[1], vertex.position[2] });
  }
  return read;
}

} // namespace

std::vector<std::uint32_t> alongCurve(std::span<const double> positions)
{
  double low[3], high = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    low[axis] = std::numeric_limits<double>::max();
    for (std::size_t i = axis; i < positions.size(); i += 3)
    {
      low[axis] = std::min(low[axis], positions[i]);
    }
    for (std::size_t i = axis; i < positions.size(); i += 3)
    {
      high = std::max(high, positions[i] - low[axis]);
    }
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(positions.size() / 3);
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    std::uint64_t key = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double x = (positions[3 * i + axis] - low[axis]) / std::max(high, 1e-300);
      const auto cell = static_cast<std::uint64_t>(x * 2097151);
      for (int bit = 0; bit < 21; ++bit)
      {
        key |= (cell >> bit & 1) << (3 * bit + int(axis));
      }
    }
    keys[i] = { key, static_cast<std::uint32_t>(i) };
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> curve;
  for (const auto& [key, vertex] : keys)
  {
    curve.push_back(vertex);
  }
  return curve;
}

PagedMesh pagesOf(const Neighbours& neighbours, std::span<const double> positions,
  std::span<const std::uint32_t> curve, int pageVertices, bool doublePositions,
  Workspace& workspace)
{
  PagedMesh mesh{ VertexPages(workspace, pageVertices, doublePositions), {}, {}, 1, 0 };
  mesh.sampleStride = std::int64_t(std::max<std::size_t>(1, curve.size() / Samples));
  std::vector<std::uint32_t> ranks(neighbours.vertices(), NoIndex);
  for (std::size_t i = 0; i < curve.size(); ++i)
  {
    ranks[curve[i]] = static_cast<std::uint32_t>(i);
    for (std::size_t axis = 0; axis < 3 && i % std::size_t(mesh.sampleStride) == 0; ++axis)
    {
      mesh.samples.push_back(static_cast<float>(positions[3 * std::size_t(curve[i]) + axis]));
    }
  }
  for (std::size_t first = 0; first < curve.size(); first += std::size_t(pageVertices))
  {
    const auto page =
      curve.subspan(first, std::min(std::size_t(pageVertices), curve.size() - first));
    std::vector<std::uint32_t> lists;
    for (const std::uint32_t vertex : page)
    {
      for (const std::uint32_t other : neighbours[vertex])
      {
        lists.push_back(ranks[other]);
      }
    }
    std::vector<VertexPages::Vertex> vertices;
    std::size_t begin = 0;
    for (const std::uint32_t vertex : page)
    {
      const double* x = positions.data() + std::size_t(3) * vertex;
      const std::size_t degree = neighbours[vertex].size();
      vertices.push_back({ { x[0], x[1], x[2] }, vertex, NoIndex,
        std::span<const std::uint32_t>(lists).subspan(begin, degree) });
      begin += degree;
    }
    mesh.pages.append(vertices);
  }
  mesh.pages.close();
  return mesh;
}

PagedMesh pagesOf(const IndexedTestMesh& mesh, int pageVertices, Workspace& workspace)
{
  return pagesOf(
    neighboursOf(mesh), mesh.positions, alongCurve(mesh.positions), pageVertices, true, workspace);
}

ReadOrder readOrder(const OrderedVertices& order)
{
  return order.doublePositions ? readOrderAs<double>(order) : readOrderAs<float>(order);
}

void expectOrder(const Neighbours& neighbours, const ReadOrder& order, std::size_t count)
{
  std::vector<std::uint32_t> places(neighbours.vertices(), NoIndex);
  ASSERT_EQ(order.ids.size(), count);
  for (std::size_t i = 0; i < count; ++i)
  {
    ASSERT_LT(order.ids[i], places.size());
    ASSERT_EQ(places[order.ids[i]], NoIndex) << "twice: vertex " << order.ids[i];
    places[order.ids[i]] = static_cast<std::uint32_t>(i);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    auto reach = static_cast<std::uint32_t>(i);
    for (const std::uint32_t other : neighbours[order.ids[i]])
    {
      reach = std::max(reach, places[other]);
    }
    ASSERT_EQ(order.reaches[i], reach) << "at place " << i;
  }
}

} // namespace smg::testing
