// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/LevelWindow.h"

#include "Solver/Core/SimdPack.h"
#include "Solver/Multigrid/Cycle/LevelWindowState.txx"

#include <algorithm>
#include <string>
#include <utility>

namespace smg
{

template <class Real>
void LevelWindow<Real>::useScratch(const ScratchFolder& folder, ScratchTraffic& traffic)
{
  const std::string level = "level" + std::to_string(this->Index);
  this->Rows.emplace(folder, level + ".rows", traffic.add("rows", this->Index));
  this->Values.emplace(folder, level + ".state", traffic.add("state", this->Index));
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
  this->Rows->startPass(first);
  this->Values->startPass(true);
  if (this->RightSide)
  {
    this->RightSide->startPass(first || this->Next);
  }
}

template <class Real>
void LevelWindow<Real>::renew(int columns, bool apart)
{
  this->WrittenColumns = columns;
  if (apart)
  {
    this->Next.emplace(*this->Owner, this->Stride);
  }
}

template <class Real>
void LevelWindow<Real>::endPass()
{
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
  this->CachedBlock = -1;
}

template <class Real>
void LevelWindow<Real>::append(RowBlock block)
{
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
  RowBlock block = this->readRows(*this->Rows, nodes);
  const auto values = static_cast<std::size_t>(nodes * this->Columns);
  Buffer state = this->SpareState.take(2 * values * sizeof(Real));
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

/** Reads the next block, of `nodes` nodes. */
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
