// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/SharedVertices.h"

#include <algorithm>
#include <string>

// Which vertices of a part other processes own or use, and the exchange of numbers at these. A
// vertex has one owner; numbers go from the users of a vertex to its owner or back, in one message
// for each pair of processes, both of which list the vertices in the same order, so that no indices
// are sent.

namespace smg
{

SharedVertices::SharedVertices(Team& team, const MeshPart& part)
  : Processes(team)
  , Ids(part.ids)
{
  struct Range
  {
    std::int64_t begin, end, vertices;
  };
  // All processes check the ranges of all: the same error on each, and the same ends for ownerOf().
  const std::vector<Range> ranges =
    team.gather(std::vector<Range>{ { part.firstOwned, part.endOwned, part.info.vertices } });
  std::int64_t expected = 0;
  for (std::size_t p = 0; p < ranges.size(); ++p)
  {
    if (ranges[p].begin != expected || ranges[p].end < expected)
    {
      throw Error("the parts of the mesh do not fit together: process " + std::to_string(p) +
                  " owns the vertices from " + std::to_string(ranges[p].begin) + " to " +
                  std::to_string(ranges[p].end) + ", but should begin with vertex " +
                  std::to_string(expected));
    }
    expected = ranges[p].end;
    this->Ends.push_back(expected);
  }
  if (ranges.front().vertices > 0 && expected != ranges.front().vertices)
  {
    throw Error("the parts of the mesh do not fit together: the processes own " +
                std::to_string(expected) + " vertices of " +
                std::to_string(ranges.front().vertices));
  }
  // The ids ascend, so the own vertices are contiguous in the part.
  this->Begin = std::ranges::lower_bound(this->Ids, part.firstOwned) - this->Ids.begin();
  this->End = std::ranges::lower_bound(this->Ids, part.endOwned) - this->Ids.begin();
  this->checkIds();

  // Each process tells the owners which of their vertices it has. The lists of both sides
  // correspond: entry k of Foreign[p] here is entry k of Used[this process] on process p.
  this->Foreign.resize(static_cast<std::size_t>(team.size()));
  std::vector<std::vector<std::int64_t>> ids(this->Foreign.size());
  for (std::int64_t v = 0; v < this->vertices(); ++v)
  {
    if (!this->isOwn(v))
    {
      const auto owner = static_cast<std::size_t>(this->ownerOf(this->id(v)));
      this->Foreign[owner].push_back(v);
      ids[owner].push_back(this->id(v));
    }
  }
  this->Used = team.exchange(ids);
  // A vertex of another owner is shared, since its owner has it as well; an own one if others use
  // it.
  this->Shared.assign(this->Ids.size(), 1);
  std::fill(this->Shared.begin() + this->Begin, this->Shared.begin() + this->End, 0);
  for (std::vector<std::int64_t>& used : this->Used)
  {
    for (std::int64_t& v : used)
    {
      // From a stream index to a place in the part.
      v += this->Begin - part.firstOwned;
      this->Shared[static_cast<std::size_t>(v)] = 1;
    }
  }
}

/** Checks the stream indices of this process against the ranges: an own vertex that the part lacks
 * would have no row, and one beyond the mesh no owner. */
void SharedVertices::checkIds() const
{
  const bool ascend =
    std::ranges::adjacent_find(this->Ids, std::ranges::greater_equal()) == this->Ids.end();
  const bool inside =
    this->Ids.empty() || (this->Ids.front() >= 0 && this->Ids.back() < this->Ends.back());
  const auto rank = static_cast<std::size_t>(this->Processes.rank());
  const std::int64_t owned = this->Ends[rank] - (rank == 0 ? 0 : this->Ends[rank - 1]);
  if (!ascend || !inside || this->End - this->Begin != owned)
  {
    throw Error("the part of process " + std::to_string(rank) +
                " is not valid: its vertices must ascend, and be all that it owns and others of "
                "the mesh");
  }
}

std::int64_t SharedVertices::find(std::int64_t id) const
{
  // The ids ascend: a binary search.
  const auto place = std::ranges::lower_bound(this->Ids, id);
  return place != this->Ids.end() && *place == id ? place - this->Ids.begin() : -1;
}

/** The first process whose range ends behind the index; processes that own nothing are passed
 * over. */
int SharedVertices::ownerOf(std::int64_t id) const
{
  return static_cast<int>(std::ranges::upper_bound(this->Ends, id) - this->Ends.begin());
}

/** Contributions are added in the order of the processes, so the sum depends on the partition, but
 * not on which message arrives first. */
void SharedVertices::addToOwners(std::span<double> values, int lanes) const
{
  const auto each = static_cast<std::size_t>(lanes);
  const auto received =
    this->Processes.exchange(pack(this->Foreign, std::span<const double>(values), each));
  for (std::size_t p = 0; p < received.size(); ++p)
  {
    for (std::size_t k = 0; k < received[p].size(); ++k)
    {
      values[static_cast<std::size_t>(this->Used[p][k / each]) * each + k % each] += received[p][k];
    }
  }
}

} // namespace smg
