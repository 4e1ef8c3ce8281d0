// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/Ring.h"
#include "Solver/Stream/MeshSource.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace smg
{

/** An edge from an open vertex to a neighbour, with the weight that the cells so far give it. */
struct OpenEdge
{
  std::int64_t to;
  double weight;
};

/**
 * The edges of the vertices that are not final yet. Each vertex has room for a usual number of
 * neighbours; the few that have more keep the others in a table aside.
 */
class OpenEdges
{
public:
  /** Neighbours that a vertex of a usual mesh has at most. */
  static constexpr int usual(CellType type) { return type == CellType::Triangle ? 12 : 24; }

  /** `usual`: neighbours that a vertex has room for. */
  OpenEdges(Pool& pool, int usual)
    : Edges(pool, usual)
    , Counts(pool)
  {
  }

  void extend(std::int64_t vertices)
  {
    this->Edges.extendRaw(vertices);
    this->Counts.extend(vertices);
  }
  void release(std::int64_t first)
  {
    this->Edges.release(first);
    this->Counts.release(first);
  }

  /** The edge from -> to, made with weight 0 if it is not there. */
  OpenEdge& edge(std::int64_t from, std::int64_t to)
  {
    OpenEdge* list = this->Edges.at(from);
    std::int32_t& count = this->Counts[from];
    for (std::int32_t e = 0; e < count; ++e)
    {
      if (list[e].to == to)
      {
        return list[e];
      }
    }
    if (count < this->Edges.lanes())
    {
      list[count] = { to, 0.0 };
      return list[count++];
    }
    return this->More[from].try_emplace(to, OpenEdge{ to, 0.0 }).first->second;
  }

  /** Moves the edges of `from` to `edges`, by ascending neighbour. */
  void take(std::int64_t from, std::vector<OpenEdge>& edges)
  {
    const OpenEdge* list = this->Edges.at(from);
    const std::int32_t count = this->Counts[from];
    edges.assign(list, list + count);
    if (count == this->Edges.lanes())
    {
      if (const auto more = this->More.find(from); more != this->More.end())
      {
        for (const auto& [to, edge] : more->second)
        {
          edges.push_back(edge);
        }
        this->More.erase(more);
      }
    }
    if (edges.size() > 32)
    {
      std::sort(edges.begin(), edges.end(),
        [](const OpenEdge& a, const OpenEdge& b) { return a.to < b.to; });
      return;
    }
    for (std::size_t e = 1; e < edges.size(); ++e)
    {
      const OpenEdge edge = edges[e];
      std::size_t place = e;
      for (; place > 0 && edges[place - 1].to > edge.to; --place)
      {
        edges[place] = edges[place - 1];
      }
      edges[place] = edge;
    }
  }

private:
  Ring<OpenEdge> Edges;
  Ring<std::int32_t> Counts;
  std::unordered_map<std::int64_t, std::unordered_map<std::int64_t, OpenEdge>> More;
};

} // namespace smg
