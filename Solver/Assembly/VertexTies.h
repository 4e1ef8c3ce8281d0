// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Pool.h"
#include "Solver/Memory/Ring.h"
#include "smg/Export.h"
#include "smg/Problem.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace smg
{

/**
 * The couplings of a problem (VertexCouplings) as a stream of its vertices meets them: which vertex
 * is the unknown of another one, and how long a vertex must wait for those that are coupled to it.
 *
 * An unknown has its own cells and those of the vertices that are tied to it. Its row is complete
 * when all of these are final: closable() holds it back until then, and with it all later rows. So
 * the window of a pass grows with the distance of coupled vertices in the stream.
 *
 * Functions of ascending vertices take a step each; a problem without couplings costs a test.
 */
class SMG_EXPORT VertexTies
{
public:
  VertexTies(Pool& pool, const Problem& problem);

  /** Whether any vertices are one unknown. */
  bool any() const { return this->Of && !this->Of->ties.empty(); }
  bool anyJump() const { return this->Of && !this->Of->jumps.empty(); }
  bool anyLink() const { return this->Of && !this->Of->links.empty(); }

  /** Adds the next vertices, up to `end`. */
  void extend(std::int64_t end);
  /** Provides room for this many more. */
  void reserve(std::int64_t more)
  {
    if (this->any())
    {
      this->Nodes.reserveMore(more);
    }
  }
  void release(std::int64_t first)
  {
    if (this->any())
    {
      this->Nodes.release(first);
    }
  }

  /** The vertex whose unknown an open vertex has: itself unless it is tied. */
  std::int64_t node(std::int64_t vertex) const
  {
    return this->any() ? this->Nodes[vertex] : vertex;
  }
  bool isTied(std::int64_t vertex) const { return this->node(vertex) != vertex; }
  /** By how much the value of a vertex is more than that of its node, a number per column; null: by
   * nothing. */
  const double* jump(std::int64_t vertex) const;
  /** Calls visit(vertex) for the vertices whose unknown is `node`, itself first, then in ascending
   * order. */
  template <class Visit>
  void forVerticesOf(std::int64_t node, Visit&& visit) const
  {
    visit(node);
    for (std::size_t t = this->any() ? this->firstOf(node) : this->ByNode.size();
         t < this->ByNode.size() && this->ByNode[t].to == node; ++t)
    {
      visit(this->ByNode[t].vertex);
    }
  }
  /** Calls visit(link) for the links of a vertex to higher ones, in ascending order. */
  template <class Visit>
  void forLinks(std::int64_t from, Visit&& visit) const
  {
    if (!this->anyLink())
    {
      return;
    }
    const auto& links = this->Of->links;
    for (auto link = std::ranges::lower_bound(links, from, {}, &VertexCouplings::Link::from);
         link != links.end() && link->from == from; ++link)
    {
      visit(*link);
    }
  }

  /** The contacts of the links. */
  std::span<const VertexCouplings::Contact> contacts() const
  {
    return this->Of ? std::span<const VertexCouplings::Contact>(this->Of->contacts)
                    : std::span<const VertexCouplings::Contact>();
  }

  /** Up to which vertex rows can be completed if no later cell has a vertex below `final`, which is
   * never less than before. */
  std::int64_t closable(std::int64_t final);

  /** Throws Error unless a tied vertex and its node agree: both have a prescribed value, which
   * differs by the jump, or neither. `values`: `columns` a vertex. */
  void require(std::int64_t vertex, const Ring<std::int32_t>& dirichlet, const Ring<double>& values,
    const double* point) const;

private:
  /** A vertex that must wait for a later one. */
  struct Wait
  {
    std::int64_t vertex, forVertex;
  };

  std::size_t firstOf(std::int64_t node) const
  {
    return static_cast<std::size_t>(
      std::ranges::lower_bound(this->ByNode, node, {}, &VertexCouplings::Tie::to) -
      this->ByNode.begin());
  }

  std::shared_ptr<const VertexCouplings> Of; ///< null: there are none
  Reservation Reserved;
  std::vector<VertexCouplings::Tie> ByNode; ///< by ascending node, then vertex
  std::vector<Wait> Waits;                  ///< by ascending vertex
  std::size_t Waiting = 0;                  ///< the first of Waits that may still wait
  Ring<std::int64_t> Nodes;                 ///< of open vertices, if any are tied
  std::size_t Next = 0;                     ///< the first tie of a vertex that is not open yet
};

/** The largest distance in the stream of two vertices that are coupled; 0: none are. */
std::int64_t reachOf(const VertexCouplings* couplings);

/** What vertices that are tied have more than their nodes. */
enum class TiedDifference
{
  Jump,
  None ///< in a correction of values that have the jumps
};

/** Sets the values of the tied ones among the vertices from `first` on, `columns` numbers each,
 * given those of the others; read(node, value) gives those of earlier ones. */
void completeTied(const VertexCouplings& couplings, TiedDifference difference, std::int64_t first,
  std::size_t columns, std::span<double> values,
  const std::function<void(std::int64_t node, std::span<double> value)>& read);

} // namespace smg
