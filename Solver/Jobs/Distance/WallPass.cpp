// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/WallPass.h"

#include "Solver/Core/RunAll.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smg
{

WallPass::WallPass(std::span<const TrianglePoints> points,
  std::span<const std::array<std::int64_t, 3>> numbers, bool isFirst, WallValues values, Pool& pool)
  : Points(points)
  , Numbers(numbers)
  , Tree(pool, points)
  , IsFirst(isFirst)
  , Values(values)
  , Memory(pool, static_cast<std::size_t>(WallValues::ChunkVertices * WallValues::VertexBytes))
{
  std::byte* next = this->Memory.data();
  const auto part = [&]<class T>(std::span<T>& of, std::int64_t components)
  {
    const auto count = static_cast<std::size_t>(components * WallValues::ChunkVertices);
    of = { reinterpret_cast<T*>(next), count };
    next += of.size_bytes();
  };
  part(this->Position, 3);
  part(this->Distance, 1);
  part(this->Source, 1);
  part(this->Direction, 3);
}

void WallPass::add(std::span<const double> positions, tbb::task_arena& threads)
{
  while (!positions.empty())
  {
    const auto room = static_cast<std::size_t>(3 * (WallValues::ChunkVertices - this->Count));
    const auto part = positions.first(std::min(positions.size(), room));
    std::ranges::copy(part, this->Position.begin() + 3 * this->Count);
    positions = positions.subspan(part.size());
    this->Count += static_cast<std::int64_t>(part.size() / 3);
    if (this->Count == WallValues::ChunkVertices)
    {
      this->lowerChunk(threads);
    }
  }
}

void WallPass::finish(tbb::task_arena& threads)
{
  if (this->Count > 0)
  {
    this->lowerChunk(threads);
  }
}

void WallPass::lowerChunk(tbb::task_arena& threads)
{
  this->loadChunk();
  constexpr std::int64_t PartVertices = 1024;
  runAll(threads, static_cast<int>((this->Count + PartVertices - 1) / PartVertices),
    [this](int part)
    {
      const std::int64_t begin = part * PartVertices;
      this->lower(begin, std::min(begin + PartVertices, this->Count));
    });
  this->writeChunk();
  ++this->Chunk;
  this->Count = 0;
}

void WallPass::lower(std::int64_t begin, std::int64_t end)
{
  // The triangle nearest to a vertex is a good guess for the next one.
  std::int64_t guess = -1;
  for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v)
  {
    const double* point = this->Position.data() + 3 * v;
    const TriangleTree::Nearest nearest = this->Tree.nearest(point, this->Distance[v], guess);
    if (nearest.triangle < 0)
    {
      continue;
    }
    guess = nearest.triangle;
    const auto triangle = static_cast<std::size_t>(nearest.triangle);
    const TrianglePoints& corners = this->Points[triangle];
    const Vector away = difference(point, nearestPoint(corners, point).data());
    const double distance = nearest.distance;
    this->Distance[v] = distance;
    for (int k = 0; k < 3; ++k)
    {
      this->Direction[3 * v + k] = distance > 0 ? static_cast<float>(away[k] / distance) : 0.0F;
    }
    if (this->Values.sources)
    {
      const auto squareTo = [point](const double* corner)
      {
        const Vector way = difference(point, corner);
        return dot(way, way);
      };
      const auto corner = std::ranges::min_element(corners.point, {}, squareTo) - corners.point;
      this->Source[v] = this->Numbers[triangle][static_cast<std::size_t>(corner)];
    }
  }
}

void WallPass::forParts(auto visit)
{
  const auto count = static_cast<std::size_t>(this->Count);
  visit(WallValues::Distances, std::as_writable_bytes(this->Distance.first(count)));
  if (this->Values.sources)
  {
    visit(WallValues::Sources, std::as_writable_bytes(this->Source.first(count)));
  }
  if (this->Values.directions)
  {
    visit(WallValues::Directions, std::as_writable_bytes(this->Direction.first(3 * count)));
  }
}

void WallPass::loadChunk()
{
  if (this->IsFirst)
  {
    std::ranges::fill(this->Distance, std::numeric_limits<double>::infinity());
    return;
  }
  this->forParts([this](int part, std::span<std::byte> bytes)
    { this->Values.file.read(this->Chunk * WallValues::Parts + part, bytes); });
}

void WallPass::writeChunk()
{
  this->forParts([this](int part, std::span<std::byte> bytes)
    { this->Values.file.write(this->Chunk * WallValues::Parts + part, bytes); });
}

} // namespace smg
