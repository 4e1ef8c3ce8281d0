// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <utility>

namespace smg
{

/** Whether long work on a part in memory is to go on: calls a function, which may throw Cancelled,
 * now and then. */
class Poll
{
public:
  explicit Poll(std::function<void()> function = {})
    : Function(std::move(function))
  {
  }

  void now() const
  {
    if (this->Function)
    {
      this->Function();
    }
  }
  /** The same in step `i` of a loop, where it is the turn. */
  void at(std::size_t i) const
  {
    constexpr std::size_t Steps = std::size_t(1) << 14; // a few milliseconds
    if (i % Steps == 0)
    {
      this->now();
    }
  }

private:
  std::function<void()> Function;
};

} // namespace smg
