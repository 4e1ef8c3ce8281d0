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

void RestShape::useScratch(const ScratchFolder& folder, IoStatistics& statistics)
{
  this->Scratch.emplace(folder, "rest", statistics);
  this->Scratch->startPass(true);
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

/** An edge to a held neighbour; called before close() of its vertex, which is the next one of the
 * open block. */
void RestShape::link(std::int32_t delta, double weight)
{
  this->Links.push_back({ this->Open.nodes, delta, static_cast<float>(weight) });
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
  // `reach` does not decrease, so the last vertex of a group determines the reach of the group.
  this->Open.reach[static_cast<std::size_t>(this->Open.nodes / RowBlock::Group)] = reach;
  ++this->Open.nodes;
  ++this->Vertices;
  // These blocks coincide with the blocks of the rows.
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
  if (this->Scratch)
  {
    this->Scratch->endPass();
  }
}

/** Completes the open block. */
void RestShape::pack()
{
  this->Open.held = static_cast<std::int32_t>(this->Held.size());
  this->Open.links = static_cast<std::int32_t>(this->Links.size());
  Buffer buffer(this->Owner, RestBlock::bytes(this->Open));
  // The bytes stay where they are when the buffer moves into the block.
  const std::span<const std::byte> bytes = buffer.bytes();
  RestBlock block(std::move(buffer));
  block.header() = this->Open;
  std::copy(this->Points.begin(), this->Points.end(), block.points().begin());
  std::copy(this->Held.begin(), this->Held.end(), block.held().begin());
  std::copy(this->Links.begin(), this->Links.end(), block.links().begin());
  if (this->Scratch)
  {
    this->Scratch->append(bytes);
  }
  else
  {
    this->Blocks.push_back(std::move(block));
  }
  this->Open = {};
  this->Open.first = this->Vertices;
  this->Points.clear();
  this->Held.clear();
  this->Links.clear();
}

void RestShape::save(StateWriter& state)
{
  state.part("rest");
  state(this->Vertices, this->Low, this->High);
  this->Scratch->save(state);
}

void RestShape::load(StateReader& state)
{
  state.part("rest");
  state(this->Vertices, this->Low, this->High);
  state.require(this->Vertices > 0);
  this->Scratch->load(state, (this->Vertices - 1) / RowBlock::Nodes + 1,
    [&](std::int64_t index, std::span<const std::byte> bytes)
    {
      RestBlock::Header h;
      state.require(bytes.size() >= sizeof(h));
      std::memcpy(&h, bytes.data(), sizeof(h));
      const std::int64_t first = index * RowBlock::Nodes;
      const std::int64_t nodes = std::min(RowBlock::Nodes, this->Vertices - first);
      // What is read from a checkpoint is checked before it is used as sizes and indices.
      state.require(h.first == first && h.nodes == nodes && h.held >= 0 && h.links >= 0 &&
                    RestBlock::bytes(h) == bytes.size());
    });
}

double RestShape::extent() const
{
  return std::hypot(
    this->High[0] - this->Low[0], this->High[1] - this->Low[1], this->High[2] - this->Low[2]);
}

void RestShape::startPass()
{
  this->NextBlock = 0;
  if (this->Scratch)
  {
    this->Scratch->startPass(false);
  }
}

RestBlock RestShape::next()
{
  if (!this->Scratch)
  {
    // In memory, a pass looks at the blocks and leaves them.
    return this->Blocks[this->NextBlock++].view();
  }
  Buffer buffer(this->Owner, this->Scratch->nextBytes());
  this->Scratch->read(buffer.bytes());
  return RestBlock(std::move(buffer));
}

void RestShape::endPass()
{
  if (this->Scratch)
  {
    this->Scratch->endPass();
  }
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
  const auto take = [this](const RestBlock& block)
  {
    this->CachedPoints.assign(block.points().begin(), block.points().end());
    for (const RestBlock::Held& held : block.held())
    {
      std::copy(held.target.begin(), held.target.end(), this->CachedPoints.begin() + 3 * held.node);
    }
  };
  if (!this->Scratch)
  {
    take(this->Blocks[static_cast<std::size_t>(number)]);
    // Not cached: in memory it costs little, and an interactive deformation changes the targets.
    return;
  }
  Buffer buffer(this->Owner, this->Scratch->bytes(number));
  this->Scratch->read(number, buffer.bytes());
  take(RestBlock(std::move(buffer)));
  this->Cached = number;
}

} // namespace smg
