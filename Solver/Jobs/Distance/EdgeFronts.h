// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Distance/FrontInterval.h"
#include "Solver/Memory/Buffer.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/**
 * The intervals of the front on each edge of a window, disjoint and in order: of two that meet on
 * an edge, each keeps where it is nearer (Mitchell, Mount and Papadimitriou 1987). Edges are
 * numbers below `edges`, and intervals have numbers, too.
 *
 * An interval waits until it is taken, to be passed on to the triangles of its edge; from then on
 * it only shadows others.
 */
class EdgeFronts
{
public:
  EdgeFronts(Pool& pool, std::int64_t edges);

  const FrontInterval& at(std::uint32_t number) const { return this->Nodes[number].interval; }
  /** Whether there still is such an interval, not taken. A number may be that of another one by
   * now. */
  bool isWaiting(std::uint32_t number) const { return this->Nodes[number].state == Waiting; }
  void take(std::uint32_t number) { this->Nodes[number].state = Taken; }

  /** Adds an interval to an edge, where it is nearer than those that are there. Returns the numbers
   * of all parts that are to wait in a queue, until the next call. */
  std::span<const std::uint32_t> insert(std::uint32_t edge, const FrontInterval& interval);
  /** Whether so much is remembered that forget() should be called. */
  bool isFull() const { return this->Used >= this->Most; }
  /** Forgets all intervals of the edges for which isPassed(one of the intervals), none of which may
   * be waiting. */
  template <class IsPassed>
  void forget(const IsPassed& isPassed)
  {
    std::erase_if(this->Edges,
      [&](std::uint32_t edge)
      {
        const std::uint32_t head = this->Heads[edge];
        const bool passes = head == None || isPassed(this->at(head));
        if (passes)
        {
          this->removeAll(edge);
        }
        return passes;
      });
    this->Most = std::max(LeastMost, 2 * this->Used);
  }
  void clear();

private:
  static constexpr std::uint32_t None = FrontInterval::None;
  static constexpr std::size_t LeastMost = 1 << 14;

  enum State : std::uint32_t
  {
    Waiting,
    Taken,
    Unused
  };
  struct Node
  {
    FrontInterval interval;
    std::uint32_t next; ///< of the edge, or of those without use
    State state;
  };
  class Insertion;

  std::uint32_t create(const FrontInterval& interval, State state);
  void remove(std::uint32_t number);
  void removeAll(std::uint32_t edge);

  Pool& Owner;
  Buffer Memory, HeadMemory;
  Node* Nodes = nullptr;
  std::uint32_t* Heads;             ///< the first interval of each edge
  std::vector<std::uint32_t> Edges; ///< that have intervals
  std::vector<std::uint32_t> Added;
  std::uint32_t Free = None;
  std::size_t Created = 0, Used = 0, Most = LeastMost;
};

} // namespace smg
