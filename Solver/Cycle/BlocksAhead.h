// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>

namespace smg
{

/** Blocks that have been read and are to be taken in order. */
template <class Block>
class BlocksAhead
{
public:
  /** Calls `read` while there are `more`, until there are as many blocks as were taken since the
   * last time, and at least one. */
  template <class More, class Read>
  void fill(More&& more, Read&& read)
  {
    const std::size_t wanted = std::max<std::size_t>(1, std::exchange(this->Taken, 0));
    while (this->Blocks.size() < wanted && more())
    {
      this->Blocks.push_back(read());
    }
  }

  /** The next block: one that has been read, or what `read` answers. */
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

private:
  std::deque<Block> Blocks;
  std::size_t Taken = 0; // since fill()
};

} // namespace smg
