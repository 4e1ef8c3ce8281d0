// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/VertexTies.h"

#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace smg
{

VertexTies::VertexTies(Pool& pool, const Problem& problem)
  : Of(problem.couplings())
  , Reserved(pool)
  , Nodes(pool)
{
  if (!this->Of)
  {
    return;
  }
  this->Reserved.resize(static_cast<std::int64_t>(
    this->Of->ties.size() * (sizeof(VertexCouplings::Tie) + sizeof(Wait)) +
    this->Of->links.size() * sizeof(Wait)));
  this->ByNode = this->Of->ties;
  std::ranges::sort(this->ByNode, [](const VertexCouplings::Tie& a, const VertexCouplings::Tie& b)
    { return a.to != b.to ? a.to < b.to : a.vertex < b.vertex; });
  this->Waits.reserve(this->ByNode.size() + this->Of->links.size());
  for (const VertexCouplings::Tie& tie : this->ByNode)
  {
    this->Waits.push_back({ tie.to, tie.vertex });
  }
  for (const VertexCouplings::Link& link : this->Of->links)
  {
    this->Waits.push_back({ link.from, link.to });
  }
  std::ranges::sort(this->Waits, {}, &Wait::vertex);
}

void VertexTies::extend(std::int64_t end)
{
  if (!this->any())
  {
    return;
  }
  const std::vector<VertexCouplings::Tie>& ties = this->Of->ties;
  const std::int64_t begin = this->Nodes.end();
  this->Nodes.extendRaw(end);
  for (std::int64_t vertex = begin; vertex < end; ++vertex)
  {
    const bool isTied = this->Next < ties.size() && ties[this->Next].vertex == vertex;
    this->Nodes[vertex] = isTied ? ties[this->Next].to : vertex;
    this->Next += isTied ? 1 : 0;
  }
}

const double* VertexTies::jump(std::int64_t vertex) const
{
  if (!this->anyJump())
  {
    return nullptr;
  }
  const std::vector<VertexCouplings::Tie>& ties = this->Of->ties;
  const auto tie = std::ranges::lower_bound(ties, vertex, {}, &VertexCouplings::Tie::vertex);
  if (tie == ties.end() || tie->vertex != vertex)
  {
    return nullptr;
  }
  const std::size_t columns = this->Of->jumps.size() / ties.size();
  return this->Of->jumps.data() + static_cast<std::size_t>(tie - ties.begin()) * columns;
}

std::int64_t VertexTies::closable(std::int64_t final)
{
  while (this->Waiting < this->Waits.size() && this->Waits[this->Waiting].forVertex < final)
  {
    ++this->Waiting;
  }
  return this->Waiting < this->Waits.size() ? std::min(final, this->Waits[this->Waiting].vertex)
                                            : final;
}

void VertexTies::require(std::int64_t vertex, const Ring<std::int32_t>& dirichlet,
  const Ring<double>& values, const double* point) const
{
  const std::int64_t to = this->node(vertex);
  const bool isPrescribed = dirichlet[vertex] >= 0;
  bool agrees = isPrescribed == (dirichlet[to] >= 0);
  const double* jump = this->jump(vertex);
  for (int k = 0; agrees && isPrescribed && k < values.lanes(); ++k)
  {
    const double value = values.at(vertex)[k], expected = values.at(to)[k] + (jump ? jump[k] : 0.0);
    // To the digits in which users state numbers.
    agrees = std::fabs(value - expected) <=
             1e-9 * (std::fabs(value) + std::fabs(expected) + std::fabs(jump ? jump[k] : 0.0));
  }
  if (!agrees)
  {
    throw Error(
      "dirichlet: prescribes the vertex at (" + shortest(point[0]) + ", " + shortest(point[1]) +
      ", " + shortest(point[2]) +
      ") otherwise than the one that \"periodic\" makes the same unknown: state the condition on "
      "both sides, with values that differ by the jump");
  }
}

std::int64_t reachOf(const VertexCouplings* couplings)
{
  std::int64_t reach = 0;
  if (couplings)
  {
    for (const VertexCouplings::Tie& tie : couplings->ties)
    {
      reach = std::max(reach, tie.vertex - tie.to);
    }
    for (const VertexCouplings::Link& link : couplings->links)
    {
      reach = std::max(reach, link.to - link.from);
    }
  }
  return reach;
}

void completeTied(const VertexCouplings& couplings, TiedDifference difference, std::int64_t first,
  std::size_t columns, std::span<double> values,
  const std::function<void(std::int64_t node, std::span<double> value)>& read)
{
  const std::vector<VertexCouplings::Tie>& ties = couplings.ties;
  const std::int64_t end = first + static_cast<std::int64_t>(values.size() / columns);
  const auto begin = std::ranges::lower_bound(ties, first, {}, &VertexCouplings::Tie::vertex);
  std::vector<std::vector<VertexCouplings::Tie>::const_iterator> found;
  for (auto tie = begin; tie != ties.end() && tie->vertex < end; ++tie)
  {
    found.push_back(tie);
  }
  // By ascending nodes: those are read from blocks on disk.
  std::ranges::sort(found, {}, [](auto tie) { return tie->to; });
  const auto valueOf = [&](std::int64_t vertex)
  { return values.subspan(static_cast<std::size_t>(vertex - first) * columns, columns); };
  for (const auto& tie : found)
  {
    const std::span<double> value = valueOf(tie->vertex);
    if (tie->to >= first)
    {
      std::ranges::copy(valueOf(tie->to), value.begin());
    }
    else
    {
      read(tie->to, value);
    }
    const bool jumps = difference == TiedDifference::Jump && !couplings.jumps.empty();
    for (std::size_t k = 0; jumps && k < columns; ++k)
    {
      value[k] += couplings.jumps[static_cast<std::size_t>(tie - ties.begin()) * columns + k];
    }
  }
}

} // namespace smg
