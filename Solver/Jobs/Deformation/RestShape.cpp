// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Deformation/RestShape.h"

#include <algorithm>
#include <cmath>
#include <cstring>

// The mesh at rest and its targets, in blocks as they are needed by the pass that the two problems
// of a deformation share. They are collected in the first pass as a RowListener, that is, in the
// order in which rows are completed.
//
// On several threads, hold() is called where the problem is asked, ahead of link() and close(),
// which are called where rows are completed. The targets go through two queues: hold() fills
// Coming, begin(), between two steps, moves them to Waiting, and close() takes them from there. So
// the two threads never touch the same queue.

namespace smg
{

void RestShape::useScratch(const ScratchFolder& folder, ScratchTraffic& traffic)
{
  this->Records.useScratch(folder, traffic);
  this->System.useScratch(folder, traffic);
}

void RestShape::hold(std::int64_t i, const double* target)
{
  this->Coming.push_back({ { target[0], target[1], target[2] }, i });
}

void RestShape::begin()
{
  this->Waiting.insert(this->Waiting.end(), this->Coming.begin(), this->Coming.end());
  this->Coming.clear();
}

/** Adds a vertex to the open block, with its target if it is held. */
void RestShape::close(const double* point, std::int64_t reach)
{
  this->enclose(point);
  if (!this->Waiting.empty() && this->Waiting.front().node == this->Vertices)
  {
    this->Held.push_back({ this->Waiting.front().target, this->Open.nodes });
    // The extent includes the targets: the size of residuals is estimated by it.
    this->enclose(this->Held.back().target.data());
    this->Waiting.pop_front();
  }
  this->Points.insert(this->Points.end(), point, point + 3);
  this->System.close(point, reach);
  ++this->Open.nodes;
  ++this->Vertices;
  if (this->Open.nodes == RowBlock::Nodes)
  {
    this->pack();
  }
}

void RestShape::enclose(const double* point)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    this->Low[k] = std::min(this->Low[k], point[k]);
    this->High[k] = std::max(this->High[k], point[k]);
  }
}

/** The last block may have fewer vertices. */
void RestShape::finish()
{
  if (this->Open.nodes > 0)
  {
    this->pack();
  }
  this->Records.finish();
  this->System.finish();
}

/** Completes the open block. */
void RestShape::pack()
{
  this->Open.held = static_cast<std::int32_t>(this->Held.size());
  Buffer buffer(this->Records.pool(), RestBlock::bytes(this->Open));
  const RestBlock block{ VertexRecords::Record(buffer.bytes()) };
  block.header() = this->Open;
  std::copy(this->Points.begin(), this->Points.end(), block.points().begin());
  std::copy(this->Held.begin(), this->Held.end(), block.held().begin());
  this->Records.append(std::move(buffer));
  this->Open = {};
  this->Open.first = this->Vertices;
  this->Points.clear();
  this->Held.clear();
}

void RestShape::save(StateWriter& state)
{
  state.part("rest");
  state(this->Vertices, this->Low, this->High);
  this->Records.save(state);
  this->System.save(state);
}

void RestShape::load(StateReader& state)
{
  state.part("rest");
  state(this->Vertices, this->Low, this->High);
  state.require(this->Vertices > 0);
  this->Records.load(state, this->blocks(),
    [&](std::int64_t index, std::span<const std::byte> bytes)
    {
      RestBlock::Header h;
      state.require(bytes.size() >= sizeof(h));
      std::memcpy(&h, bytes.data(), sizeof(h));
      const std::int64_t first = index * RowBlock::Nodes;
      const std::int64_t nodes = std::min(RowBlock::Nodes, this->Vertices - first);
      // What is read from a checkpoint is checked before it is used as sizes and indices.
      state.require(
        h.first == first && h.nodes == nodes && h.held >= 0 && RestBlock::bytes(h) == bytes.size());
    });
  this->System.load(state);
}

double RestShape::extent() const
{
  return std::hypot(
    this->High[0] - this->Low[0], this->High[1] - this->Low[1], this->High[2] - this->Low[2]);
}

/** A range is read from front to back, so that one block in memory is enough. */
void RestShape::addStart(std::int64_t first, std::int64_t count, double* values)
{
  while (count > 0)
  {
    const std::int64_t block = first / RowBlock::Nodes;
    const std::int64_t begin = block * RowBlock::Nodes;
    const std::int64_t end = std::min({ first + count, begin + RowBlock::Nodes, this->Vertices });
    if (this->Cached != block)
    {
      this->cacheStart(block);
    }
    const double* start = this->CachedPoints.data() + 3 * (first - begin);
    for (std::int64_t k = 0; k < 3 * (end - first); ++k)
    {
      *values++ += start[k];
    }
    count -= end - first;
    first = end;
  }
}

/** Sets CachedPoints to the start of the vertices of a block: their positions at rest, or
 * targets. */
void RestShape::cacheStart(std::int64_t number)
{
  const RestBlock block(this->Records.at(number));
  this->CachedPoints.assign(block.points().begin(), block.points().end());
  for (const RestBlock::Held& held : block.held())
  {
    std::copy(held.target.begin(), held.target.end(), this->CachedPoints.begin() + 3 * held.node);
  }
  this->Cached = number;
}

} // namespace smg
