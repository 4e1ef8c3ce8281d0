// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/LevelWindow.h"

#include "Solver/Core/SimdPack.h"
#include "Solver/Multigrid/Cycle/LevelWindowState.txx"

#include <algorithm>
#include <string>
#include <utility>

// The window of a level over the stream. A block of 1024 nodes goes through these steps in a pass:
// readBlock(), ahead of need and on any thread, reads rows and packed state; loadBlock() makes room
// in the rings, between two steps, when no stage runs; unpack() copies the state into them, as part
// of the first stage; the stages use the block; write() packs and appends its state, beside the
// stages of later nodes; release() gives back its memory.
//
// Rows are used in place, in the buffer that was read: only the diagonals are computed (RowBlock).
// x and b are rings with mirrored memory, so that a neighbour is x + stride * delta without a test
// for the end of the ring.
//
// Order matters for the memory, not for the result: the arithmetic is that of the stages, and the
// window only decides what is in memory when.

namespace smg
{

template <class Real>
void LevelWindow<Real>::useScratch(const ScratchFolder& folder, ScratchTraffic& traffic)
{
  const std::string level = "level" + std::to_string(this->Index);
  this->Rows.emplace(folder, level + ".rows", traffic.add("rows", this->Index));
  this->Values.emplace(folder, level + ".state", traffic.add("state", this->Index));
  // b of the finest level stays the same during a problem: in a file of its own it is read in every
  // pass, but written once. b of coarse levels is new in every pass and shares a file with x.
  if (this->finest())
  {
    this->RightSide.emplace(folder, level + ".b", traffic.add("right_side", this->Index));
  }
}

template <class Real>
void LevelWindow<Real>::startPass(bool first)
{
  this->First = first;
  this->Written = 0;
  // In memory: everything is there already, except a separate state of the downward part.
  if (!this->Rows)
  {
    if (this->Next)
    {
      this->Next->x.extendRaw(this->Nodes);
      this->Next->b.extendRaw(this->Nodes);
    }
    return;
  }
  this->Loaded = this->Read = 0;
  this->FirstBlock = 0;
  this->Now.x.restart();
  this->Now.b.restart();
  // The file of rows is written in the first pass only, x in every pass, b when it is new.
  this->Rows->startPass(first);
  this->Values->startPass(true);
  if (this->RightSide)
  {
    this->RightSide->startPass(first || this->Next);
  }
}

template <class Real>
void LevelWindow<Real>::renew(int columns, bool separate)
{
  this->WrittenColumns = columns;
  if (separate)
  {
    this->Next.emplace(*this->Owner, this->Stride);
  }
}

template <class Real>
void LevelWindow<Real>::endPass()
{
  // After a pass that two problems share, the state is that of the second one.
  this->Columns = this->WrittenColumns;
  if (!this->Rows)
  {
    if (this->Next)
    {
      std::swap(this->Now, *this->Next);
      this->Next.reset();
    }
    return;
  }
  this->Next.reset();
  this->Rows->endPass();
  this->Values->endPass();
  if (this->RightSide)
  {
    this->RightSide->endPass();
  }
  // The pass has rewritten what readX() may have cached.
  this->CachedBlock = -1;
}

template <class Real>
void LevelWindow<Real>::abandon()
{
  this->Next.reset();
  this->WrittenColumns = this->Columns;
  if (!this->Rows)
  {
    return;
  }
  this->Resident->add(this->Now.x.first() - this->Now.x.end());
  this->Ahead.clear();
  this->Packages.clear();
  this->Blocks.clear();
  this->Passed.clear();
  this->Now.x.restart();
  this->Now.b.restart();
  this->CachedBlock = -1;
}

template <class Real>
void LevelWindow<Real>::append(RowBlock block)
{
  // What exists already stays: on the finest level the state that came with the rows, on coarse
  // levels b as far as the finer level restricts to it.
  this->extendState(block.end());
  this->Nodes = this->Loaded = block.end();
  this->Blocks.push_back(std::move(block));
}

template <class Real>
void LevelWindow<Real>::load(std::int64_t node)
{
  while (this->Loaded <= node && this->Loaded < this->Nodes)
  {
    this->loadBlock();
  }
}

template <class Real>
void LevelWindow<Real>::readAhead()
{
  this->Ahead.fill([this] { return this->Rows && this->Read < this->Nodes; },
    [this] { return this->readBlock(); });
}

template <class Real>
auto LevelWindow<Real>::readBlock() -> Incoming
{
  const std::int64_t nodes = std::min(RowBlock::Nodes, this->Nodes - this->Read);
  // Into buffers of their own, not into the rings, which other threads use at this time.
  RowBlock block = this->readRows(*this->Rows, nodes);
  const auto values = static_cast<std::size_t>(nodes * this->Columns);
  Buffer state = this->SpareState.take(2 * values * sizeof(Real));
  // The same layout in both cases, x and then b.
  if (this->RightSide)
  {
    this->Values->read(state.bytes().first(values * sizeof(Real)));
    this->readRightSide({ reinterpret_cast<Real*>(state.data()) + values, values });
  }
  else
  {
    this->Values->read(state.bytes());
  }
  this->Read += nodes;
  return { std::move(block), std::move(state) };
}

/** Reads the rows of the next block, which has `nodes` nodes, and computes their diagonals,
 * which are not on disk. */
template <class Real>
RowBlock LevelWindow<Real>::readRows(ScratchStream& from, std::int64_t nodes)
{
  const std::size_t stored = from.nextBytes();
  Buffer rows = this->SpareRows.take(stored + RowBlock::diagonalBytes(nodes));
  from.read(rows.bytes().first(stored));
  RowBlock block(std::move(rows));
  block.sumDiagonals();
  return block;
}

template <class Real>
void LevelWindow<Real>::loadBlock()
{
  Incoming next = this->Ahead.take([this] { return this->readBlock(); });
  const std::int64_t begin = next.rows.first();
  const std::int64_t end = next.rows.end();
  // Growing a ring may move it: only here, between two steps. Both are the same state, except in a
  // pass that two problems share.
  for (State* state : { &this->up(), &this->down() })
  {
    state->x.extendRaw(end);
    state->b.extendRaw(end);
  }
  this->Resident->add(end - begin);
  this->Packages.push_back({ begin, end, std::move(next.state) });
  this->Blocks.push_back(std::move(next.rows));
  this->Loaded = end;
}

template <class Real>
void LevelWindow<Real>::unpack()
{
  for (Arrived& arrived : this->Packages)
  {
    const auto* x = reinterpret_cast<const Real*>(arrived.state.data());
    this->unpack(this->Now.x, arrived.begin, arrived.end, x);
    this->unpack(
      this->Now.b, arrived.begin, arrived.end, x + (arrived.end - arrived.begin) * this->Columns);
    this->EmptyState.give(std::move(arrived.state));
  }
  this->Packages.clear();
}

template <class Real>
void LevelWindow<Real>::readRightSide(std::span<Real> b)
{
  // A block of zeros has no bytes, but is read all the same: the file counts blocks.
  const bool zero = this->RightSide->nextBytes() == 0;
  this->RightSide->read(std::as_writable_bytes(zero ? std::span<Real>() : b));
  if (zero)
  {
    std::fill(b.begin(), b.end(), Real{});
  }
}

template <class Real>
void LevelWindow<Real>::appendRightSide(std::span<const Real> b)
{
  const bool zero = std::all_of(b.begin(), b.end(), [](Real value) { return value == Real{}; });
  this->RightSide->append(std::as_bytes(zero ? std::span<const Real>() : b));
}

template <class Real>
void LevelWindow<Real>::write(std::int64_t done)
{
  if (!this->Rows)
  {
    return;
  }
  // Blocks are records of the files: each is written as a whole, once all its nodes are done.
  while (this->Written < done)
  {
    const std::int64_t begin = this->Written;
    const std::int64_t end = this->block(begin).end();
    if (end > done)
    {
      break;
    }
    if (this->First)
    {
      this->Rows->append(this->block(begin).stored());
    }
    const auto values = static_cast<std::size_t>((end - begin) * this->WrittenColumns);
    this->Packed.resize(2 * values);
    const State& state = this->down();
    this->pack(state.x, this->WrittenColumns, begin, end, this->Packed.data());
    this->pack(state.b, this->WrittenColumns, begin, end, this->Packed.data() + values);
    const auto packed = std::as_bytes(std::span<const Real>(this->Packed));
    this->Values->append(this->RightSide ? packed.first(packed.size() / 2) : packed);
    // b of the finest level: when it is new, after assembly or for the second problem.
    if (this->RightSide && (this->First || this->Next))
    {
      this->appendRightSide(std::span<const Real>(this->Packed).last(values));
    }
    this->Written = end;
  }
}

template <class Real>
void LevelWindow<Real>::release(std::int64_t done)
{
  if (!this->Rows)
  {
    return;
  }
  this->EmptyState.giveTo(this->SpareState);
  // Rows and b are needed by their own node only: released as soon as the block has passed the last
  // stage and is on disk.
  while (!this->Blocks.empty() && this->Blocks.front().end() <= std::min(done, this->Written))
  {
    const RowBlock& front = this->Blocks.front();
    const RowBlock::Header& h = front.header();
    this->Passed.push_back({ front.end(), h.neighbourReach[groupIn(h, front.end() - 1)] });
    this->up().b.release(front.end());
    this->down().b.release(front.end());
    this->SpareRows.give(this->Blocks.front().takeBuffer());
    this->Blocks.pop_front();
    ++this->FirstBlock;
  }
  // x is read by neighbours: it waits until the largest neighbour of the block has passed, too.
  while (!this->Passed.empty() && this->Passed.front().reach < done)
  {
    const std::int64_t end = this->Passed.front().end;
    this->Resident->add(this->Now.x.first() - end);
    this->up().x.release(end);
    this->down().x.release(end);
    this->Passed.pop_front();
  }
}

template <class Real>
void LevelWindow<Real>::pack(
  const Ring<Real>& state, int columns, std::int64_t begin, std::int64_t end, Real* packed) const
{
  unpad(state.at(begin), this->Stride, columns, end - begin, packed);
}

template <class Real>
void LevelWindow<Real>::unpack(
  Ring<Real>& state, std::int64_t begin, std::int64_t end, const Real* packed)
{
  pad(packed, this->Columns, end - begin, state.at(begin));
}

/** Makes a streamed level a core level, if the hierarchy turns out to end with it. */
template <class Real>
void LevelWindow<Real>::moveToMemory()
{
  if (!this->Rows)
  {
    return;
  }
  this->Loaded = this->Read = this->FirstBlock = 0;
  this->Now.x.restart();
  this->Now.b.restart();
  this->Rows->startPass(false);
  this->Values->startPass(false);
  this->load(this->Nodes - 1);
  this->unpack();
  for (SpareBuffers* spare : { &this->SpareRows, &this->SpareState, &this->EmptyState })
  {
    spare->clear();
  }
  // Without files, the window takes the level as one in memory from here on.
  this->Rows.reset();
  this->Values.reset();
  this->RightSide.reset();
}

template <class Real>
void LevelWindow<Real>::keepSolution()
{
  for (SpareBuffers* spare : { &this->SpareRows, &this->SpareState, &this->EmptyState })
  {
    spare->clear();
  }
  this->Blocks.clear();
  this->Now.b.clear();
  // On disk, the file of values has x; in memory, the ring has it.
  if (this->Rows)
  {
    this->Now.x.clear();
    this->Rows.reset();
    this->RightSide.reset();
  }
}

template <class Real>
void LevelWindow<Real>::readX(std::int64_t first, std::int64_t count, Real* values)
{
  if (!this->Values)
  {
    this->pack(this->Now.x, this->Columns, first, first + count, values);
    return;
  }
  while (count > 0)
  {
    const std::int64_t block = first / RowBlock::Nodes;
    const std::int64_t begin = block * RowBlock::Nodes;
    // Consecutive ranges often share a block, which is read and verified once.
    if (block != this->CachedBlock)
    {
      this->Packed.resize(this->Values->bytes(block) / sizeof(Real));
      this->Values->read(block, std::as_writable_bytes(std::span<Real>(this->Packed)));
      this->CachedBlock = block;
    }
    const std::int64_t end = std::min(first + count, begin + RowBlock::Nodes);
    values = std::copy_n(
      this->Packed.data() + (first - begin) * this->Columns, (end - first) * this->Columns, values);
    count -= end - first;
    first = end;
  }
}

template class LevelWindow<double>;
template class LevelWindow<float>;

} // namespace smg
