// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Cycle/IterateHistory.h"

#include "Solver/Cycle/RowBlock.h"

#include <algorithm>
#include <numeric>

namespace smg
{

void IterateHistory::useScratch(const std::filesystem::path& folder, IoStatistics& statistics)
{
  this->Stream.emplace(folder / "level0.history", statistics);
}

void IterateHistory::startPass(const StepWeights& weights)
{
  this->Weights = weights;
  this->Written = 0;
  std::fill(this->Sums.begin(), this->Sums.end(), 0.0);
  this->Before.restart();
  if (this->Stream)
  {
    this->Kept.restart();
    this->Stream->startPass(true);
  }
}

void IterateHistory::load(const Ring<double>& x, std::int64_t end)
{
  const std::int64_t begin = this->Before.end();
  this->Before.extendRaw(end);
  std::copy(x.at(begin), x.at(end), this->Before.at(begin));
  if (this->First)
  {
    this->Kept.extend(end);
    return;
  }
  for (std::int64_t first = this->Kept.end(); first < end; first += RowBlock::Nodes)
  {
    const std::int64_t stop = std::min(end, first + RowBlock::Nodes);
    this->Kept.extendRaw(stop);
    this->Stream->read(
      std::as_writable_bytes(std::span<float>(this->Kept.at(first), this->Kept.at(stop))));
  }
}

void IterateHistory::combine(const Ring<double>& x, std::int64_t begin, std::int64_t end)
{
  for (std::int64_t i = begin; i < end; ++i)
  {
    double* value = x.at(i);
    const double* before = this->Before.at(i);
    float* step = this->Kept.at(i);
    for (int k = 0; k < this->Stride; ++k)
    {
      const double change = this->Weights.correction * (value[k] - before[k]) +
                            this->Weights.momentum * static_cast<double>(step[k]);
      value[k] = before[k] + change;
      step[k] = static_cast<float>(change);
    }
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
    const std::int64_t end = std::min(this->Kept.end(), this->Written + RowBlock::Nodes);
    if (end > done)
    {
      break;
    }
    this->Stream->append(
      std::as_bytes(std::span<const float>(this->Kept.at(this->Written), this->Kept.at(end))));
    this->Written = end;
    this->Kept.release(end);
    this->Before.release(end);
  }
}

void IterateHistory::endPass()
{
  this->First = false;
  if (this->Stream)
  {
    this->Stream->endPass();
  }
}

ResidualProducts IterateHistory::products() const
{
  const auto sum = [this](int n)
  {
    const double* first = this->Sums.data() + static_cast<std::ptrdiff_t>(n * this->Stride);
    return std::accumulate(first, first + this->Stride, 0.0);
  };
  return { sum(0), sum(1), sum(2), sum(3), sum(4) };
}

} // namespace smg
