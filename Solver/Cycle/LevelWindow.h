// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/BlocksAhead.h"
#include "Solver/Cycle/Lanes.h"
#include "Solver/Cycle/LevelCursors.h"
#include "Solver/Cycle/RowBlock.h"
#include "Solver/Cycle/Transfer.h"
#include "Solver/Storage/Ring.h"
#include "Solver/Storage/ScratchStream.h"
#include "Solver/Storage/ScratchTraffic.h"
#include "Solver/Storage/SpareBuffers.h"
#include "smg/Export.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/**
 * What of a level is in memory: blocks of rows, and the state x and b, `stride` values a node. With
 * scratch files, blocks and state come from them and go to them as the pass proceeds; without, all
 * of the level stays in memory and loading, writing and releasing cost nothing.
 */
template <class Real>
class SMG_EXPORT LevelWindow
{
public:
  /** The unknowns and the right-hand side of the nodes in memory. */
  struct State
  {
    State(Pool& pool, int stride)
      : x(pool, stride)
      , b(pool, stride)
    {
    }
    Ring<Real> x, b;
  };

  LevelWindow(Pool& pool, ResidentNodes& resident, int index, int columns)
    : Owner(&pool)
    , Resident(&resident)
    , Index(index)
    , Columns(columns)
    , WrittenColumns(columns)
    , Stride(strideOf(columns))
    , Now(pool, this->Stride)
    , SpareRows(pool)
    , SpareState(pool)
  {
  }

  /** Keeps the level in scratch files in `folder`. */
  void useScratch(const std::filesystem::path& folder, ScratchTraffic& traffic);

  int columns() const { return this->Columns; }
  int stride() const { return this->Stride; }
  Ring<Real>& x() { return this->Now.x; }
  Ring<Real>& b() { return this->Now.b; }
  /** What the way up and the way down of a pass work on: the same, but in a pass that renews. */
  State& up() { return this->Now; }
  State& down() { return this->Next ? *this->Next : this->Now; }
  /** Nodes of the level; while it is being built, those that have come. */
  std::int64_t nodes() const { return this->Nodes; }
  std::int64_t loaded() const { return this->Loaded; }
  /** The first node whose row is there; those before it have gone through all stages. */
  std::int64_t first() const { return this->FirstBlock * RowBlock::Nodes; }

  /** The header of the block of node `node`, which is loaded. */
  const RowBlock::Header& header(std::int64_t node) const { return this->block(node).header(); }
  static std::size_t groupIn(const RowBlock::Header& h, std::int64_t node)
  {
    return static_cast<std::size_t>((node - h.first) / RowBlock::Group);
  }
  static std::int64_t groupEnd(const RowBlock::Header& h, std::int64_t node)
  {
    const std::int64_t group = (node - h.first) / RowBlock::Group;
    return h.first + std::min<std::int64_t>(h.nodes, (group + 1) * RowBlock::Group);
  }
  /** From `cursor` on, how far all neighbours are below `done`. */
  std::int64_t reachable(std::int64_t cursor, std::int64_t done) const
  {
    while (cursor < done)
    {
      const RowBlock::Header& h = this->header(cursor);
      if (h.neighbourReach[groupIn(h, cursor)] >= done)
      {
        break;
      }
      cursor = groupEnd(h, cursor);
    }
    return cursor;
  }

  void startPass(bool first);
  void endPass();

  /**
   * The next pass is the last of one problem and the first of another one with `columns` columns,
   * of the same stride. With `apart` (finest level) the way down has a state of its own, which
   * another stage has to fill.
   */
  void renew(int columns, bool apart);
  /** Without scratch files: forgets a pass that was broken off. */
  void abandon() { this->Next.reset(); }
  /** Without scratch files, between passes: the state is that of a problem with so many columns. */
  void setColumns(int columns) { this->Columns = this->WrittenColumns = columns; }

  /** First pass: state of nodes below `end`, zero. */
  void extendState(std::int64_t end)
  {
    this->Now.x.extend(end);
    this->extendB(end);
  }
  /** First pass: right-hand side of nodes below `end`, zero. */
  void extendB(std::int64_t end)
  {
    const std::int64_t before = this->Now.b.end();
    if (end > before)
    {
      this->Now.b.extend(end);
      this->Resident->add(end - before);
    }
  }
  /** First pass: takes the next block of rows. */
  void append(RowBlock block);

  /** Loads up to node `node`. */
  void load(std::int64_t node);
  /** Reads as many blocks as load() has taken since, which it will take first. Other threads may
   * work on what is loaded. */
  void readAhead();
  /** Writes the state of the blocks that lie below `done`. Other threads may work above. */
  void write(std::int64_t done);
  /** Lets go of what is written and no node from `done` on needs: of rows and b, which are a node's
   * own, and of x, which its neighbours need longer. */
  void release(std::int64_t done);

  void zeroB(std::int64_t begin, std::int64_t end)
  {
    std::ranges::fill(this->Now.b.range(begin, end), Real{});
  }

  /** Calls f(header, arrays, nodes, x, b) for the part of [begin, end) in each block; x and b of
   * `state` point to the block's node 0. */
  template <class F>
  void forRange(std::int64_t begin, std::int64_t end, State& state, F&& f)
  {
    while (begin < end)
    {
      const RowBlock& block = this->block(begin);
      const RowBlock::Header& h = block.header();
      const std::int64_t stop = std::min(end, block.end());
      const BlockRange nodes{ begin - h.first, stop - h.first };
      Real* x = state.x.at(h.first);
      Real* b = state.b.at(h.first);
      block.visit<Real>([&](const auto& arrays) { f(h, arrays, nodes, x, b); });
      begin = stop;
    }
  }

  /** Calls f(header, arrays, k) with the block of node `node`, which has number k there. */
  template <class F>
  void visitRow(std::int64_t node, F&& f) const
  {
    const RowBlock& block = this->block(node);
    block.visit<Real>([&](const auto& arrays) { f(block.header(), arrays, node - block.first()); });
  }

  /** Between passes, after the first one: calls f(block, b) for the b of every block of
   * RowBlock::Nodes nodes, without padding, and keeps what it makes of it. */
  template <class F>
  void rewriteB(F&& f);

  /** Gives buffers of blocks that were let go of to those who make more in the first pass. */
  void giveSpareRows(SpareBuffers& others) { this->SpareRows.giveTo(others, MostSpareRows); }

  /** Between passes: loads the whole level, which stays in memory from here on. */
  void moveToMemory();

  /** Lets go of all but x, for readX(). */
  void keepSolution();

  /** Reads x of nodes [first, first + count), without padding, from memory or scratch. */
  void readX(std::int64_t first, std::int64_t count, Real* values);

private:
  /** About what a step packs; more would cost memory. */
  static constexpr std::size_t MostSpareRows = 4;

  const RowBlock& block(std::int64_t node) const
  {
    return this->Blocks[static_cast<std::size_t>(node / RowBlock::Nodes - this->FirstBlock)];
  }
  bool finest() const { return this->Index == 0; }
  /** A block and its x and b, without padding, as they have been read. */
  struct Incoming
  {
    RowBlock rows;
    Buffer state;
  };
  Incoming readBlock();
  void loadBlock();
  /** Most right-hand sides are zero but near constraints: a block of zeros takes no room on disk.
   */
  void readRightSide(std::span<Real> b);
  void appendRightSide(std::span<const Real> b);
  void pack(
    const Ring<Real>& state, int columns, std::int64_t begin, std::int64_t end, Real* packed) const;
  void unpack(Ring<Real>& state, std::int64_t begin, std::int64_t end, const Real* packed);

  Pool* Owner;
  ResidentNodes* Resident;
  int Index;
  int Columns;        // of the state that is read ...
  int WrittenColumns; // ... and of what is written
  int Stride;
  State Now;
  std::optional<State> Next; // of the way down, in a pass that renews
  std::deque<RowBlock> Blocks;
  /** Blocks whose x is still there: where they end, and their largest neighbour. */
  struct PassedBlock
  {
    std::int64_t end, reach;
  };
  std::deque<PassedBlock> Passed;
  std::int64_t FirstBlock = 0; // number of Blocks.front() among all blocks of the level
  std::int64_t Nodes = 0;
  std::int64_t Loaded = 0;
  std::int64_t Written = 0;
  bool First = true;

  // Scratch: rows are written once, x in every pass; b in the first pass (finest) or with x.
  std::optional<ScratchStream> Rows, RightSide, Values;
  std::vector<Real> Packed;
  std::int64_t Read = 0; // nodes of the blocks that have been read, and those to be taken
  BlocksAhead<Incoming> Ahead;
  SpareBuffers SpareRows, SpareState;
  std::int64_t CachedBlock = -1; // of readX
};

template <class Real>
template <class F>
void LevelWindow<Real>::rewriteB(F&& f)
{
  if (this->RightSide)
  {
    this->RightSide->startPass(true);
  }
  for (std::int64_t first = 0; first < this->Nodes; first += RowBlock::Nodes)
  {
    const std::int64_t end = std::min(this->Nodes, first + RowBlock::Nodes);
    this->Packed.resize(static_cast<std::size_t>((end - first) * this->Columns));
    const std::span<Real> b(this->Packed);
    if (this->RightSide)
    {
      this->readRightSide(b);
      f(first / RowBlock::Nodes, b);
      this->appendRightSide(b);
    }
    else
    {
      this->pack(this->Now.b, this->Columns, first, end, b.data());
      f(first / RowBlock::Nodes, b);
      this->unpack(this->Now.b, first, end, b.data());
    }
  }
  if (this->RightSide)
  {
    this->RightSide->endPass();
  }
}

extern template class LevelWindow<double>;
extern template class LevelWindow<float>;

} // namespace smg
