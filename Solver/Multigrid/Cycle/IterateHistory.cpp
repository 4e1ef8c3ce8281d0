// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/IterateHistory.h"

#include "Solver/Core/SimdPack.h"

#include <algorithm>
#include <numeric>
#include <utility>

// The stages of acceleration in a pass: load() and keep() copy the iterate before the upward part
// changes it, combine() replaces T(y_k) by the accelerated iterate between the last sweep and
// restriction, and ResidualKeeper updates the vectors of conjugate residuals while restriction
// computes the residual. The formulas are at IterateHistory and StepWeights.
//
// Acceleration needs no additional pass: its weights come from inner products of the pass before. A
// scratch file, level0.history, has the vectors of a block of nodes as one record, steps first,
// then the residuals of the sampled nodes; it is read and rewritten in every pass, like the state
// of the level.

namespace smg
{

void IterateHistory::useScratch(const ScratchFolder& folder, IoStatistics& statistics)
{
  this->Stream.emplace(folder, "level0.history", statistics);
}

void IterateHistory::startPass(const StepWeights& weights)
{
  this->Weights = weights;
  this->Written = this->Read = this->Kept = this->Unpacked = 0;
  std::fill(this->Sums.begin(), this->Sums.end(), 0.0);
  // y_k exists only during a pass. In memory, steps and residuals stay from pass to pass; from disk
  // they are read anew.
  this->Before.restart();
  if (this->Stream)
  {
    this->Steps.restart();
    this->Residuals.restart();
    this->Stream->startPass(true);
  }
}

void IterateHistory::load(std::int64_t end)
{
  this->Before.extendRaw(end);
  // Whole blocks, so possibly beyond `end`; the rings only grow here, while no other thread uses
  // them.
  while (this->Steps.end() < end)
  {
    this->loadBlock();
  }
}

/** Runs with the first stage of the finest level, so x is still as it was loaded, and may touch
 * only what load() has added. */
void IterateHistory::keep(const Ring<double>& x)
{
  const std::int64_t end = this->Before.end();
  std::ranges::copy(x.range(this->Kept, end), this->Before.at(this->Kept));
  this->Kept = end;
  for (Buffer& block : this->Packages)
  {
    const std::int64_t begin = this->Unpacked;
    this->Unpacked = this->blockEnd(begin);
    const auto* packed = reinterpret_cast<const float*>(block.data());
    packed = this->unpack(this->Steps, begin, this->Unpacked, packed);
    this->unpack(
      this->Residuals, this->sampledBelow(begin), this->sampledBelow(this->Unpacked), packed);
    this->Empty.give(std::move(block));
  }
  this->Packages.clear();
}

void IterateHistory::readAhead()
{
  // Nothing is on disk before the first pass with this history has ended.
  this->Ahead.fill([this] { return this->Stream && !this->First && this->Read < this->Nodes; },
    [this] { return this->readBlock(); });
}

/** Reads the steps of the next block and the residuals of its sampled nodes. */
Buffer IterateHistory::readBlock()
{
  const std::int64_t end = this->blockEnd(this->Read);
  const std::int64_t sampled = this->sampledBelow(end) - this->sampledBelow(this->Read);
  const std::int64_t values = (end - this->Read + Vectors * sampled) * this->Columns;
  Buffer block = this->Spare.take(static_cast<std::size_t>(values) * sizeof(float));
  this->Stream->read(block.bytes());
  this->Read = end;
  return block;
}

void IterateHistory::loadBlock()
{
  const std::int64_t begin = this->Steps.end();
  const std::int64_t end = this->blockEnd(begin);
  // No iterate before the first one: zero steps, which a momentum of zero multiplies anyway.
  if (this->First)
  {
    this->Steps.extend(end);
    this->Residuals.extend(this->sampledBelow(end));
    return;
  }
  this->Steps.extendRaw(end);
  this->Residuals.extendRaw(this->sampledBelow(end));
  this->Packages.push_back(this->Ahead.take([this] { return this->readBlock(); }));
}

/** y_{k+1} = y_k + correction (T(y_k) - y_k) + momentum (y_k - y_{k-1}), one column or four at a
 * time. */
void IterateHistory::combine(const Ring<double>& x, std::int64_t begin, std::int64_t end)
{
  if (this->Stride == 1)
  {
    this->combineLanes<SimdPack<double, 1>>(x, begin, end, 0);
  }
  for (int lane = 0; lane + 3 < this->Stride; lane += 4)
  {
    this->combineLanes<SimdPack<double, 4>>(x, begin, end, lane);
  }
}

template <class Vectors>
void IterateHistory::combineLanes(
  const Ring<double>& x, std::int64_t begin, std::int64_t end, int lane)
{
  using Wide = typename Vectors::Vector;
  using Single = SimdPack<float, Vectors::count>;
  double* value = x.at(begin) + lane;
  const double* before = this->Before.at(begin) + lane;
  float* step = this->Steps.at(begin) + lane;
  const double correction = this->Weights.correction;
  const double momentum = this->Weights.momentum;
  for (std::int64_t i = begin; i < end; ++i)
  {
    const Wide old = Vectors::load(before);
    const Wide change = correction * (Vectors::load(value) - old) +
                        momentum * __builtin_convertvector(Single::load(step), Wide);
    // The step is stored as it was computed, before the sum is rounded: later passes extrapolate
    // it.
    Vectors::store(value, old + change);
    Single::store(step, __builtin_convertvector(change, typename Single::Vector));
    value += this->Stride;
    before += this->Stride;
    step += this->Stride;
  }
}

void IterateHistory::write(std::int64_t done)
{
  if (!this->Stream)
  {
    return;
  }
  while (this->Written < done)
  {
    const std::int64_t begin = this->Written;
    const std::int64_t end = this->blockEnd(begin);
    // A block is a record of the file: it is written as a whole or not yet.
    if (end > done)
    {
      break;
    }
    this->Packed.clear();
    this->pack(this->Steps, begin, end);
    this->pack(this->Residuals, this->sampledBelow(begin), this->sampledBelow(end));
    this->Stream->append(std::as_bytes(std::span<const float>(this->Packed)));
    this->Written = end;
  }
}

void IterateHistory::release()
{
  this->Empty.giveTo(this->Spare);
  this->Before.release(this->Written);
  if (this->Stream)
  {
    this->Steps.release(this->Written);
    this->Residuals.release(this->sampledBelow(this->Written));
  }
}

/** Fills items [begin, end) of a ring from packed values; returns what follows these. An item
 * has one vector of `Columns` values (steps) or three (residuals). */
const float* IterateHistory::unpack(
  Ring<float>& ring, std::int64_t begin, std::int64_t end, const float* packed) const
{
  const std::int64_t vectors = (end - begin) * (ring.lanes() / this->Stride);
  pad(packed, this->Columns, vectors, ring.at(begin));
  return packed + vectors * this->Columns;
}

/** Appends items [begin, end) of a ring to Packed, without padding. */
void IterateHistory::pack(const Ring<float>& ring, std::int64_t begin, std::int64_t end)
{
  const std::int64_t vectors = (end - begin) * (ring.lanes() / this->Stride);
  const std::size_t before = this->Packed.size();
  this->Packed.resize(before + static_cast<std::size_t>(vectors * this->Columns));
  unpad(ring.at(begin), this->Stride, this->Columns, vectors, this->Packed.data() + before);
}

void IterateHistory::endPass()
{
  this->First = false;
  if (this->Stream)
  {
    this->Stream->endPass();
  }
}

/** The sums determine the weights of the next pass; everything else is in the file. */
void IterateHistory::save(StateWriter& state)
{
  state.part("history");
  state(this->Sums);
  this->Stream->save(state);
}

void IterateHistory::load(StateReader& state)
{
  // A checkpoint of another number of columns must not change the size.
  const std::size_t sums = this->Sums.size();
  state.part("history");
  state(this->Sums);
  state.require(this->Sums.size() == sums);
  this->Stream->load(state, (this->Nodes - 1) / RowBlock::Nodes + 1);
  this->First = false;
}

ResidualProducts IterateHistory::products() const
{
  // Over all lanes; those that pad the columns are zero.
  const auto sum = [this](int n)
  {
    const double* first = this->Sums.data() + static_cast<std::ptrdiff_t>(n * this->Stride);
    return std::accumulate(first, first + this->Stride, 0.0);
  };
  return { sum(0), sum(1), sum(2), sum(3), sum(4) };
}

} // namespace smg
