// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace smg
{

/**
 * The stages that nodes pass one after the other, cut into chains of consecutive stages that take
 * about the same time. Chains may run on different threads, each on other nodes. The more chains,
 * the more nodes lie between the first stage and the last one, and the larger the windows.
 *
 * A chain starts a step with the cursors that the other chains had published at its beginning.
 * Neither the results nor the memory depend on which thread is faster.
 */
class SMG_EXPORT Pipeline
{
public:
  /** Advances a stage as far as possible. It `follows` the stage before it on the same thread,
   * or that one may be advancing on another thread at the same time. */
  using Advance = std::function<void(bool follows)>;

  /** Appends a stage that takes about `cost`, in any unit. */
  void add(double cost, Advance advance);
  /** Cuts the stages into at most this many chains, at least 1. */
  void cut(int chains);
  /** Makes a chain of each stage. */
  void cutAll();

  /** The number of chains for a number of threads: twice as many, since chains are not equally
   * long and a thread should find another one when it is done. */
  static int chainsFor(int threads) { return threads == 1 ? 1 : 2 * threads; }
  /** The nodes of a step, given the usual number for a few threads. Many threads need longer
   * steps, in which the time of each stage is closer to its mean. */
  static std::int64_t stepFor(int threads, std::int64_t nodes)
  {
    constexpr int Many = 6;
    const bool isAll = nodes > std::numeric_limits<std::int64_t>::max() / 2;
    return threads < Many || isAll ? nodes : 2 * nodes;
  }
  std::vector<double> costs() const;
  int chains() const { return static_cast<int>(this->Ends.size()); }
  /** Advances the stages of a chain, one after the other. */
  void advance(int chain) const;
  /** Advances all stages. */
  void advance() const;
  /** The number of stages in the chains before this one. */
  std::size_t begin(int chain) const
  {
    return chain == 0 ? 0 : this->Ends[static_cast<std::size_t>(chain) - 1];
  }

private:
  struct Stage
  {
    double cost;
    Advance advance;
  };

  std::vector<Stage> Stages;
  std::vector<std::size_t> Ends; // of each chain, the end of its stages in Stages
};

} // namespace smg
