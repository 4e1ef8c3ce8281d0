// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Edges.h"
#include "Solver/Assembly/Facets.h"
#include "Solver/Distributed/SharedVertices.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** The number of cells that several processes have, compared by their vertices. Called on all
 * processes. */
std::int64_t repeatedCells(const SharedVertices& vertices, const MeshPart& part);

/** Sums the weights of the edges that several parts have. One process gets the sum, the others
 * leave the edge out (EdgeStiffness::Elsewhere). Called on all processes. */
void joinSharedEdges(const SharedVertices& vertices, EdgeStiffness& edges);

/** The facets that have one cell in this part, but several in all parts together. Called on all
 * processes. */
FacetSet innerFacets(const SharedVertices& vertices, CellType type, const OpenFacets& facets);

/** An item that a process has sent to the meeting. Items are the same if their `key` is equal: an
 * array of stream indices, whose first one is a vertex of the item. */
template <class Item, class Answer>
struct Meeting
{
  Item item;
  Answer answer{};
  int process = 0;
  std::size_t place = 0; ///< among the items of the process
};

/**
 * Joins items that several processes may have. They meet at the owner of the first vertex of their
 * key, which calls join(meetings) for all items of a key, in the order of the processes, to set
 * their answers.
 * @return the answer to each of the items of this process, in their order
 */
template <class Answer, class Item, class Join>
std::vector<Answer> rendezvous(
  const SharedVertices& vertices, const std::vector<Item>& items, Join&& join)
{
  Team& team = vertices.team();
  const auto processes = static_cast<std::size_t>(team.size());
  std::vector<std::vector<Item>> sent(processes);
  std::vector<std::size_t> owners;
  for (const Item& item : items)
  {
    owners.push_back(static_cast<std::size_t>(vertices.ownerOf(item.key[0])));
    sent[owners.back()].push_back(item);
  }
  const std::vector<std::vector<Item>> received = team.exchange(sent);
  std::vector<Meeting<Item, Answer>> meetings;
  std::vector<std::vector<Answer>> answers(processes);
  for (std::size_t p = 0; p < processes; ++p)
  {
    for (std::size_t k = 0; k < received[p].size(); ++k)
    {
      meetings.push_back({ received[p][k], {}, static_cast<int>(p), k });
    }
    answers[p].resize(received[p].size());
  }
  std::ranges::stable_sort(
    meetings, [](const auto& a, const auto& b) { return a.item.key < b.item.key; });
  for (auto first = meetings.begin(); first != meetings.end();)
  {
    const auto last = std::find_if(
      first, meetings.end(), [&](const auto& other) { return other.item.key != first->item.key; });
    join(std::span(first, last));
    first = last;
  }
  for (const auto& meeting : meetings)
  {
    answers[static_cast<std::size_t>(meeting.process)][meeting.place] = meeting.answer;
  }
  const std::vector<std::vector<Answer>> returned = team.exchange(answers);
  std::vector<std::size_t> next(processes);
  std::vector<Answer> result;
  for (const std::size_t owner : owners)
  {
    result.push_back(returned[owner][next[owner]++]);
  }
  return result;
}

} // namespace smg
