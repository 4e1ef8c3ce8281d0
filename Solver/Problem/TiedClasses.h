// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Problem.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Classes of vertices that are one unknown, each by a jump beside the lowest of them: disjoint
 * sets with weights (Tarjan 1979). */
class TiedClasses
{
public:
  /** For these vertices, which may be repeated, each of which is a class at first. */
  TiedClasses(std::vector<std::int64_t> vertices, std::size_t columns);

  /** Makes two vertices one unknown, of which `vertex` has `jump` more than `to`. Returns false,
   * and does nothing, if they are already, by another jump, or are the same. */
  bool join(std::int64_t vertex, std::int64_t to, std::span<const double> jump);
  /** The lowest vertex of the class of a vertex, which is itself if it is none of these. */
  std::int64_t nodeOf(std::int64_t vertex);
  /** Sets ties and jumps. */
  void fill(VertexCouplings& couplings);

private:
  std::size_t find(std::size_t member);
  std::size_t memberOf(std::int64_t vertex) const;
  std::span<double> jumpOf(std::size_t member)
  {
    return std::span(this->Jumps).subspan(member * this->Columns, this->Columns);
  }

  std::size_t Columns;
  std::vector<std::int64_t> Vertices; ///< ascending
  std::vector<std::size_t> Parents;   ///< lower members, or themselves
  std::vector<double> Jumps;          ///< `columns` a member, beside its parent
};

} // namespace smg
