// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace smg
{

/**
 * The next node that a stage will process: it has finished all nodes below. There are two values.
 * The stage itself, and stages that follow it on the same thread, use the present one. Stages on
 * other threads see the one that was published between two steps. What they may process in a step,
 * and with it the memory of the pass, is therefore independent of how far the thread of this stage
 * happens to have come.
 */
class Cursor
{
public:
  Cursor() = default;
  /** Present and published. */
  explicit Cursor(std::int64_t node)
    : Node(node)
    , Published(node)
  {
  }
  Cursor& operator=(std::int64_t node)
  {
    this->Node = node;
    return *this;
  }
  /** The present node, for the stage itself. */
  operator std::int64_t() const { return this->Node; }
  /** The node that a stage may rely on which `follows` this one on the same thread, or does not. */
  std::int64_t seen(bool follows) const { return follows ? this->Node : this->Published; }
  /** The published node, for stages on other threads. */
  std::int64_t published() const { return this->Published; }
  /** Publishes the present node. */
  void publish() { this->Published = this->Node; }

private:
  std::int64_t Node = 0;
  std::int64_t Published = 0;
};

} // namespace smg
