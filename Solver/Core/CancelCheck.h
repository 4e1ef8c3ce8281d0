// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>
#include <utility>

namespace smg
{

/** Asks in the middle of long work, of which other threads do parts, whether to go on. */
class CancelCheck
{
public:
  /** `ask` throws Cancelled if the work is to end. It is called on the thread that makes this. */
  explicit CancelCheck(std::function<void()> ask)
    : Ask(std::move(ask))
  {
  }

  /** To be called between parts of the work, on any thread: asks if the last answer is a tenth of a
   * second old. Throws what `ask` has thrown; on other threads Cancelled. */
  void operator()()
  {
    constexpr std::chrono::milliseconds Between(100);
    const bool mayAsk = std::this_thread::get_id() == this->Owner;
    if (mayAsk && std::chrono::steady_clock::now() - this->Asked > Between)
    {
      this->whileSleeping();
    }
    if (mayAsk)
    {
      this->end();
    }
    else if (this->IsOver.load(std::memory_order_acquire))
    {
      throw Cancelled();
    }
  }

  /** To be called by the owner when all parts are done: throws if the answer was no. */
  void end()
  {
    if (this->IsOver.load(std::memory_order_acquire))
    {
      std::rethrow_exception(this->Reason);
    }
  }

  /** Asks while others work, which end if the answer is no. */
  void whileSleeping() noexcept
  {
    try
    {
      this->Asked = std::chrono::steady_clock::now();
      this->Ask();
    }
    catch (...)
    {
      this->Reason = std::current_exception();
      this->IsOver.store(true, std::memory_order_release);
    }
  }

private:
  std::function<void()> Ask;
  const std::thread::id Owner = std::this_thread::get_id();
  std::chrono::steady_clock::time_point Asked = std::chrono::steady_clock::now();
  std::exception_ptr Reason; ///< of the owner
  std::atomic<bool> IsOver{ false };
};

} // namespace smg
