// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>

namespace smg
{

/** Blocks of a file or a mesh that were read ahead (prefetched) and are taken in order. fill() runs
 * beside the stages of a step, take() before the step. fill() prefetches as many blocks as the step
 * before took, so the memory follows the speed of the pass and does not depend on that of the
 * disk. */
template <class Block>
class Prefetch
{
public:
  /** Calls `read` while there are `more`, until as many blocks are available as were taken since
   * the last call, and at least one. */
  template <class More, class Read>
  void fill(More&& more, Read&& read)
  {
    const std::size_t wanted = std::max<std::size_t>(1, std::exchange(this->Taken, 0));
    while (this->Blocks.size() < wanted && more())
    {
      this->Blocks.push_back(read());
    }
  }

  /** The next block: a prefetched one, or else the result of `read`. */
  template <class Read>
  Block take(Read&& read)
  {
    ++this->Taken;
    if (this->Blocks.empty())
    {
      return read();
    }
    Block block = std::move(this->Blocks.front());
    this->Blocks.pop_front();
    return block;
  }

  void clear() { this->Blocks.clear(); }

private:
  std::deque<Block> Blocks;
  std::size_t Taken = 0; // since fill()
};

} // namespace smg
