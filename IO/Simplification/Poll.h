// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
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
    if (i % Steps == 0)
    {
      this->now();
    }
  }

  /** The same while a list gets longer: to clear new memory takes time. */
  template <class List>
  void resize(List& list, std::size_t size) const
  {
    list.reserve(size);
    while (list.size() < size)
    {
      list.resize(std::min(size, list.size() + Steps));
      this->now();
    }
    list.resize(size);
  }

private:
  static constexpr std::size_t Steps = std::size_t(1) << 14; // a few milliseconds

  std::function<void()> Function;
};

} // namespace smg
