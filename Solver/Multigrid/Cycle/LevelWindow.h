// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Prefetch.h"
#include "Solver/Core/SimdPack.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Files/ScratchStream.h"
#include "Solver/Memory/Buffer.h"
#include "Solver/Memory/Ring.h"
#include "Solver/Multigrid/Cycle/RowBlock.h"
#include "Solver/Multigrid/Schedule/Cursor.h"
#include "smg/Export.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** The number of nodes of all levels in memory, and the largest such number. */
struct ResidentNodes
{
  std::int64_t current = 0;
  std::int64_t peak = 0;

  void add(std::int64_t nodes)
  {
    this->current += nodes;
    this->peak = std::max(this->peak, this->current);
  }
};

/**
 * The cursors of a level in a pass: for each stage the next node to process. The upward part
 * (prolongation and post-smoothing) finishes a V-cycle; the downward part (pre-smoothing, residual
 * and restriction) begins the next one. One pass performs both, the downward part behind the upward
 * part.
 */
struct LevelCursors
{
  Cursor prolonged;              ///< x += P x_coarse
  std::vector<Cursor> postSweep; ///< sweeps after prolongation
  Cursor renewed;                ///< the downward part has its own state (finest level)
  std::int64_t reset = 0;        ///< b set to zero for the next V-cycle (coarse levels)
  std::vector<Cursor> preSweep;  ///< sweeps before restriction
  Cursor combined;               ///< acceleration (finest level)
  Cursor restricted;             ///< residual and restriction

  /** For each stage of the upward part, prolongation first, the end of the nodes that it is to
   * process: the nodes that this requires are loaded. */
  std::vector<std::int64_t> wanted;

  explicit LevelCursors(int sweeps)
    : postSweep(static_cast<std::size_t>(sweeps))
    , preSweep(static_cast<std::size_t>(sweeps))
    , wanted(static_cast<std::size_t>(sweeps) + 1)
  {
  }

  /** Publishes all cursors; between two steps. */
  void publish()
  {
    for (Cursor* cursor : { &this->prolonged, &this->renewed, &this->combined, &this->restricted })
    {
      cursor->publish();
    }
    std::ranges::for_each(this->postSweep, &Cursor::publish);
    std::ranges::for_each(this->preSweep, &Cursor::publish);
  }

  void rewind()
  {
    const auto sweeps = static_cast<int>(this->postSweep.size());
    *this = LevelCursors(sweeps);
  }
};

/**
 * The window of a level: the part of it that is in memory, as blocks of rows and the state, x and b
 * with `stride` values per node. With scratch files, blocks and state are read and written in order
 * as the pass proceeds; without, the whole level stays in memory, and loading, writing and
 * releasing do nothing. The stages see no difference, so the results have the same bits.
 *
 * A block has 1024 nodes. On a surface of 177 million vertices with one column, a later pass read
 * 99 and wrote 12 bytes per vertex, all levels together (docs/performance.md).
 */
template <class Real>
class SMG_EXPORT LevelWindow
{
public:
  /** The unknowns x and the right-hand side b of the nodes in memory. */
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
    , EmptyState(pool)
  {
  }

  /** Keeps the level in scratch files in `folder`. */
  void useScratch(const ScratchFolder& folder, ScratchTraffic& traffic);
  /** For a level in memory: save() keeps its rows in a scratch file in `folder`. */
  void keepRows(const ScratchFolder& folder, ScratchTraffic& traffic);

  Pool& pool() const { return *this->Owner; }
  int columns() const { return this->Columns; }
  int stride() const { return this->Stride; }
  Ring<Real>& x() { return this->Now.x; }
  Ring<Real>& b() { return this->Now.b; }
  /** The states of the upward and of the downward part of a pass: the same one, except after
   * renew() with `separate`. */
  State& up() { return this->Now; }
  State& down() { return this->Next ? *this->Next : this->Now; }
  int index() const { return this->Index; }
  /** The number of nodes of the level; in the first pass, of those so far. */
  std::int64_t nodes() const { return this->Nodes; }
  std::int64_t loaded() const { return this->Loaded; }
  /** The first node whose row is in memory; those before it have passed all stages. */
  std::int64_t first() const { return this->FirstBlock * RowBlock::Nodes; }

  /** The header of the block of node `node`, which must be loaded. */
  const RowBlock::Header& header(std::int64_t node) const { return this->block(node).header(); }
  /** The group of node `node` in its block, and the end of the nodes of that group. Reaches are
   * stored by group, so cursors move by groups. */
  static std::size_t groupIn(const RowBlock::Header& h, std::int64_t node)
  {
    return static_cast<std::size_t>((node - h.first) / RowBlock::Group);
  }
  static std::int64_t groupEnd(const RowBlock::Header& h, std::int64_t node)
  {
    const std::int64_t group = (node - h.first) / RowBlock::Group;
    return h.first + std::min<std::int64_t>(h.nodes, (group + 1) * RowBlock::Group);
  }
  /** The end of the nodes from `cursor` on whose neighbours are all below `done`; with
   * `patched`, also the patches of these neighbours. */
  std::int64_t reachable(std::int64_t cursor, std::int64_t done, bool patched) const
  {
    while (cursor < done)
    {
      const RowBlock::Header& h = this->header(cursor);
      if (h.reach(groupIn(h, cursor), patched) >= done)
      {
        break;
      }
      cursor = groupEnd(h, cursor);
    }
    return cursor;
  }

  void startPass(bool first);
  void endPass();

  /** Declares that the next pass is the last one of one problem and the first one of another
   * with `columns` columns and the same stride. With `separate` (finest level) the downward part
   * has a state of its own, which another stage must fill. */
  void renew(int columns, bool separate);
  /** Whether the downward part of this pass has a separate state. */
  bool isSeparate() const { return this->Next.has_value(); }
  /** Discards what an aborted pass has left; the state is that of the pass before, but in memory,
   * where it may be anything. */
  void abandon();
  /** Without scratch files, between passes: sets the number of columns of the state. */
  void setColumns(int columns) { this->Columns = this->WrittenColumns = columns; }

  /** First pass: appends nodes below `end` with x = b = 0. */
  void extendState(std::int64_t end)
  {
    this->Now.x.extend(end);
    this->extendB(end);
  }
  /** First pass: appends b = 0 for nodes below `end`: restriction adds to it before the rows of
   * these nodes exist. */
  void extendB(std::int64_t end)
  {
    const std::int64_t before = this->Now.b.end();
    if (end > before)
    {
      this->Now.b.extend(end);
      this->Resident->add(end - before);
    }
  }
  /** First pass: appends the next block of rows. */
  void append(RowBlock block);

  /** Loads the blocks up to node `node`; unpack() completes their state. */
  void load(std::int64_t node);
  /** Unpacks the state of the blocks that load() has loaded. Other threads may access the blocks
   * below these. */
  void unpack();
  /** Prefetches as many blocks as load() has taken since the last call. Other threads may access
   * loaded blocks. */
  void readAhead();
  /** Writes the state of the blocks below `done`; in the first pass, also their rows. Other
   * threads may access blocks above. */
  void write(std::int64_t done);
  /** Releases what was written and no node from `done` on needs: rows and b, which only their
   * own node needs, and x, which neighbours need for longer. */
  void release(std::int64_t done);

  void zeroB(std::int64_t begin, std::int64_t end)
  {
    std::ranges::fill(this->Now.b.range(begin, end), Real{});
  }

  /** The part of [begin, end) in the block of `begin`, with the values of `state`. */
  BlockPart<Real> partFrom(std::int64_t begin, std::int64_t end, State& state) const
  {
    const RowBlock& block = this->block(begin);
    const std::int64_t first = block.first();
    return { block, { begin - first, std::min(end, block.end()) - first }, this->Stride, 0,
      state.x.at(first), state.b.at(first) };
  }
  /** Calls kernel(arrays, part) for the part of [begin, end) in each block, with the values of
   * `state`. */
  template <class Kernel>
  void forRange(std::int64_t begin, std::int64_t end, State& state, const Kernel& kernel) const
  {
    for (; begin < end; begin = this->block(begin).end())
    {
      const BlockPart<Real> part = this->partFrom(begin, end, state);
      part.block.template visit<Real>(kernel, part);
    }
  }
  /** The same column by column, or four columns at a time: calls kernel(arrays, vectors, part),
   * where `vectors` moves that many values (SimdPack). */
  template <class Kernel>
  void forColumns(std::int64_t begin, std::int64_t end, State& state, const Kernel& kernel) const
  {
    for (; begin < end; begin = this->block(begin).end())
    {
      BlockPart<Real> part = this->partFrom(begin, end, state);
      if (this->Stride == 1)
      {
        part.block.template visit<Real>(kernel, SimdPack<Real, 1>(), part);
        continue;
      }
      for (; part.lane < part.stride; part.lane += 4, part.x += 4, part.b += 4)
      {
        part.block.template visit<Real>(kernel, SimdPack<Real, 4>(), part);
      }
    }
  }

  /** Calls f(header, arrays, k) with the block of node `node`, whose index in the block is k. */
  template <class F>
  void visitRow(std::int64_t node, F&& f) const
  {
    const RowBlock& block = this->block(node);
    block.visit<Real>([&](const auto& arrays) { f(block.header(), arrays, node - block.first()); });
  }

  /** Between passes, after the first one: calls f(block, b) for the b of every block,
   * RowBlock::Nodes nodes without padding, and stores b as f leaves it. */
  template <class F>
  void rewriteB(F&& f);
  /** The same for x, of the finest level or of one in memory. */
  template <class F>
  void rewriteX(F&& f);

  /** Moves the buffers of released blocks to `others` for reuse in the first pass. */
  void giveSpareRows(SpareBuffers& others) { this->SpareRows.giveTo(others, MaxSpareRows); }

  /** Between passes: saves and restores all that later passes need. For a level in memory this
   * is its b, from which the core cycle computes x. */
  void save(StateWriter& state);
  void load(StateReader& state);

  /** Between passes: loads the whole level, which then stays in memory. */
  void moveToMemory();

  /** Releases everything except x, for readX(). */
  void keepSolution();

  /** Reads x of nodes [first, first + count), without padding, from memory or scratch. */
  void readX(std::int64_t first, std::int64_t count, Real* values);

private:
  /** About the number of blocks that a step packs; more spare buffers would waste memory. */
  static constexpr std::size_t MaxSpareRows = 4;

  const RowBlock& block(std::int64_t node) const
  {
    return this->Blocks[static_cast<std::size_t>(node / RowBlock::Nodes - this->FirstBlock)];
  }
  bool finest() const { return this->Index == 0; }
  /** A block from disk, with its x and b without padding. */
  struct Incoming
  {
    RowBlock rows;
    Buffer state;
  };
  Incoming readBlock();
  void loadBlock();
  /** Most right-hand sides are zero away from constraints: a block of zeros takes no space on
   * disk. */
  void readRightSide(std::span<Real> b);
  void appendRightSide(std::span<const Real> b);
  void pack(
    const Ring<Real>& state, int columns, std::int64_t begin, std::int64_t end, Real* packed) const;
  void unpack(Ring<Real>& state, std::int64_t begin, std::int64_t end, const Real* packed);
  template <class F>
  void forBlocks(F&& f);
  template <class F, class Reader, class Writer>
  void rewrite(std::optional<ScratchStream>& file, Ring<Real>& inMemory, F&& f, const Reader& read,
    const Writer& append);
  RowBlock readRows(ScratchStream& from, std::int64_t nodes);
  void loadInMemory(StateReader& state, std::int64_t nodes);

  Pool* Owner;
  ResidentNodes* Resident;
  int Index;
  int Columns;        // of the state read ...
  int WrittenColumns; // ... and of the state written
  int Stride;
  State Now;
  std::optional<State> Next; // state of the downward part, in a pass after renew() with `separate`
  std::deque<RowBlock> Blocks;
  /** A released block whose x is still in memory: its end, and its largest neighbour, which must
   * pass the last stage before x can be released. */
  struct PassedBlock
  {
    std::int64_t end, reach;
  };
  std::deque<PassedBlock> Passed;
  std::int64_t FirstBlock = 0; // index of Blocks.front() in the level
  std::int64_t Nodes = 0;
  std::int64_t Loaded = 0;
  std::int64_t Written = 0;
  bool First = true;

  // Scratch files. Rows are written once; x in every pass; b together with x, but on the finest
  // level, where it does not change, only in the first pass and after renew().
  std::optional<ScratchStream> Rows, RightSide, Values;
  std::optional<ScratchStream> KeptRows; // for a level in memory: written by the first save()
  bool RowsAreKept = false;
  std::vector<Real> Packed;
  std::int64_t Read = 0; // nodes of the blocks read so far; Ahead has those not taken yet
  Prefetch<Incoming> Ahead;
  /** The packed state of a loaded block with nodes `begin` to `end`. */
  struct Arrived
  {
    std::int64_t begin, end;
    Buffer state;
  };
  std::vector<Arrived> Packages;
  SpareBuffers SpareRows, SpareState, EmptyState;
  std::int64_t CachedBlock = -1; // the block in Packed, for readX()
};

template <class Real>
template <class F>
void LevelWindow<Real>::rewriteB(F&& f)
{
  this->rewrite(
    this->RightSide, this->Now.b, f, [this](std::span<Real> b) { this->readRightSide(b); },
    [this](std::span<const Real> b) { this->appendRightSide(b); });
}

template <class Real>
template <class F>
void LevelWindow<Real>::rewriteX(F&& f)
{
  this->rewrite(
    this->Values, this->Now.x, f,
    [this](std::span<Real> x) { this->Values->read(std::as_writable_bytes(x)); },
    [this](std::span<const Real> x) { this->Values->append(std::as_bytes(x)); });
}

/** f(block, values) changes the values of each block, which read() takes from the file, if there is
 * one, and append() gives back to it. */
template <class Real>
template <class F, class Reader, class Writer>
void LevelWindow<Real>::rewrite(std::optional<ScratchStream>& file, Ring<Real>& inMemory, F&& f,
  const Reader& read, const Writer& append)
{
  // Values come from Packed, in which readX() no longer finds its block.
  this->CachedBlock = -1;
  if (file)
  {
    file->startPass(true);
  }
  for (std::int64_t first = 0; first < this->Nodes; first += RowBlock::Nodes)
  {
    const std::int64_t end = std::min(this->Nodes, first + RowBlock::Nodes);
    this->Packed.resize(static_cast<std::size_t>((end - first) * this->Columns));
    const std::span<Real> values(this->Packed);
    if (file)
    {
      read(values);
      f(first / RowBlock::Nodes, values);
      append(values);
    }
    else
    {
      this->pack(inMemory, this->Columns, first, end, values.data());
      f(first / RowBlock::Nodes, values);
      this->unpack(inMemory, first, end, values.data());
    }
  }
  if (file)
  {
    file->endPass();
  }
}

extern template class LevelWindow<double>;
extern template class LevelWindow<float>;

} // namespace smg
