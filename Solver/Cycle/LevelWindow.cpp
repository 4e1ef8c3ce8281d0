// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Cycle/LevelWindow.h"

#include <algorithm>
#include <string>

namespace smg
{

template <class Real>
void LevelWindow<Real>::useScratch(const std::filesystem::path& folder, IoStatistics& statistics)
{
  const std::string level = "level" + std::to_string(this->Index);
  this->Rows.emplace(folder / (level + ".rows"), statistics);
  this->State.emplace(folder / (level + ".state"), statistics);
  if (this->finest())
  {
    this->RightSide.emplace(folder / (level + ".b"), statistics);
  }
}

template <class Real>
void LevelWindow<Real>::startPass(bool first)
{
  this->First = first;
  this->Written = 0;
  if (!this->Rows)
  {
    return;
  }
  this->Loaded = 0;
  this->FirstBlock = 0;
  this->X.restart();
  this->B.restart();
  this->Rows->startPass(first);
  this->State->startPass(true);
  if (this->RightSide)
  {
    this->RightSide->startPass(first);
  }
}

template <class Real>
void LevelWindow<Real>::endPass()
{
  if (!this->Rows)
  {
    return;
  }
  this->Rows->endPass();
  this->State->endPass();
  if (this->RightSide)
  {
    this->RightSide->endPass();
  }
  this->CachedBlock = -1;
}

template <class Real>
void LevelWindow<Real>::append(RowBlock block)
{
  if (this->Rows)
  {
    this->Rows->append(block.buffer().bytes());
  }
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
Buffer LevelWindow<Real>::buffer(std::size_t bytes)
{
  if (!this->Spare.empty())
  {
    Buffer spare = std::move(this->Spare.back());
    this->Spare.pop_back();
    if (spare.capacity() >= bytes)
    {
      spare.resize(bytes);
      return spare;
    }
  }
  return Buffer(*this->Owner, bytes);
}

template <class Real>
void LevelWindow<Real>::loadBlock()
{
  Buffer rows = this->buffer(this->Rows->nextBytes());
  this->Rows->read(rows.bytes());
  RowBlock block(std::move(rows));
  const std::int64_t begin = block.first();
  const std::int64_t end = block.end();
  this->X.extendRaw(end);
  this->B.extendRaw(end);
  this->Resident->add(end - begin);

  const auto values = static_cast<std::size_t>((end - begin) * this->Columns);
  this->Packed.resize(2 * values);
  const std::span<Real> x(this->Packed.data(), values);
  const std::span<Real> b(this->Packed.data() + values, values);
  if (this->RightSide)
  {
    this->State->read(std::as_writable_bytes(x));
    this->RightSide->read(std::as_writable_bytes(b));
  }
  else
  {
    this->State->read(std::as_writable_bytes(std::span<Real>(this->Packed)));
  }
  this->unpack(this->X, begin, end, x.data());
  this->unpack(this->B, begin, end, b.data());
  this->Blocks.push_back(std::move(block));
  this->Loaded = end;
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
    const auto values = static_cast<std::size_t>((end - begin) * this->Columns);
    this->Packed.resize(2 * values);
    this->pack(this->X, begin, end, this->Packed.data());
    this->pack(this->B, begin, end, this->Packed.data() + values);
    const auto packed = std::as_bytes(std::span<const Real>(this->Packed));
    this->State->append(this->RightSide ? packed.first(packed.size() / 2) : packed);
    if (this->RightSide && this->First)
    {
      this->RightSide->append(packed.last(packed.size() / 2));
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
  while (!this->Blocks.empty())
  {
    const RowBlock& front = this->Blocks.front();
    const RowBlock::Header& h = front.header();
    if (front.end() > this->Written || h.neighbourReach[groupIn(h, front.end() - 1)] >= done)
    {
      break;
    }
    this->Resident->add(-h.nodes);
    this->X.release(front.end());
    this->B.release(front.end());
    if (this->Spare.size() < 2)
    {
      this->Spare.push_back(this->Blocks.front().takeBuffer());
    }
    this->Blocks.pop_front();
    ++this->FirstBlock;
  }
}

template <class Real>
void LevelWindow<Real>::pack(
  const Ring<Real>& state, std::int64_t begin, std::int64_t end, Real* packed) const
{
  const Real* node = state.at(begin);
  for (std::int64_t i = begin; i < end; ++i, node += this->Stride, packed += this->Columns)
  {
    std::copy_n(node, this->Columns, packed);
  }
}

template <class Real>
void LevelWindow<Real>::unpack(
  Ring<Real>& state, std::int64_t begin, std::int64_t end, const Real* packed)
{
  Real* node = state.at(begin);
  for (std::int64_t i = begin; i < end; ++i, node += this->Stride, packed += this->Columns)
  {
    std::copy_n(packed, this->Columns, node);
    std::fill(node + this->Columns, node + this->Stride, Real{});
  }
}

template <class Real>
void LevelWindow<Real>::moveToMemory()
{
  if (!this->Rows)
  {
    return;
  }
  this->Loaded = this->FirstBlock = 0;
  this->X.restart();
  this->B.restart();
  this->Rows->startPass(false);
  this->State->startPass(false);
  this->load(this->Nodes - 1);
  this->Rows.reset();
  this->State.reset();
  this->RightSide.reset();
}

template <class Real>
void LevelWindow<Real>::keepSolution()
{
  this->Spare.clear();
  this->Blocks.clear();
  this->B.clear();
  if (this->Rows)
  {
    this->X.clear();
    this->Rows.reset();
    this->RightSide.reset();
  }
}

template <class Real>
void LevelWindow<Real>::readX(std::int64_t first, std::int64_t count, Real* values)
{
  if (!this->State)
  {
    this->pack(this->X, first, first + count, values);
    return;
  }
  while (count > 0)
  {
    const std::int64_t block = first / RowBlock::Nodes;
    const std::int64_t begin = block * RowBlock::Nodes;
    if (block != this->CachedBlock)
    {
      this->Packed.resize(this->State->bytes(block) / sizeof(Real));
      this->State->read(block, std::as_writable_bytes(std::span<Real>(this->Packed)));
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
