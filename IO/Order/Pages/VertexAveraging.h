// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/PagedArray.h"
#include "IO/Order/Pages/VertexPages.h"
#include "Solver/Memory/Buffer.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** The adjacency of some consecutive pages in memory. */
class PageStretch
{
public:
  /** Both must outlive this object. */
  PageStretch(VertexPages& pages, Workspace& workspace)
    : Pages(pages)
    , Space(workspace)
  {
  }

  /** Loads the pages [first, end). Throws Error, Cancelled. */
  void load(std::int64_t first, std::int64_t end)
  {
    std::size_t bytes = 0;
    for (std::int64_t page = first; page < end; ++page)
    {
      bytes += this->Pages.adjacencyBytes(page);
    }
    if (bytes > this->Bytes.capacity())
    {
      this->Bytes = Buffer();
      this->Bytes = Buffer(this->Space.pool(), bytes + bytes / 4);
    }
    this->Views.clear();
    std::size_t offset = 0;
    for (std::int64_t page = first; page < end; ++page)
    {
      const std::size_t size = this->Pages.adjacencyBytes(page);
      this->Pages.read(page, { this->Bytes.data() + offset, size });
      this->Views.push_back(this->Pages.view(page, this->Bytes.data() + offset));
      offset += size;
    }
    this->First = this->Views.front().firstRank();
    this->End = this->Views.back().firstRank() + this->Views.back().vertices();
  }

  /** The ranks of the vertices. */
  std::uint32_t first() const { return this->First; }
  std::uint32_t end() const { return this->End; }

  /** Calls visit(rank) for each neighbour of a vertex of these pages. */
  template <class Visit>
  void neighbours(std::uint32_t rank, Visit&& visit) const
  {
    const auto perPage = static_cast<std::uint32_t>(this->Pages.pageVertices());
    const std::uint32_t i = rank - this->First;
    this->Views[i / perPage].neighbours(i % perPage, visit);
  }

private:
  VertexPages& Pages;
  Workspace& Space;
  Buffer Bytes;
  std::vector<PageView> Views;
  std::uint32_t First = 0, End = 0;
};

/** Smooths values of paged vertices: each is replaced by the mean of the values of its neighbours,
 * vertex by vertex. Vertices with a value below `least` do not change. */
class VertexAveraging
{
public:
  /** All arguments must outlive this object. */
  VertexAveraging(VertexPages& pages, Workspace& workspace, PagedArray<float>& values, float least);

  /** Two sweeps over all vertices, from the first to the last and back. */
  void sweepVertices();

  /** The same, but the vertices of a patch within `run` consecutive ranks get a common value, the
   * mean of their neighbours outside: this smooths long waves, for which single vertices would
   * need many sweeps. */
  void sweepRuns(std::int64_t run, PagedArray<std::uint32_t>& patches);

private:
  /** The vertices of a patch in a run. */
  struct Group
  {
    std::uint32_t patch;
    std::uint32_t edges;
    double sum;
  };

  template <class Take>
  void forEachPageBothWays(Take&& take);
  void averageRun(std::uint32_t begin, std::uint32_t end, PagedArray<std::uint32_t>& patches);

  VertexPages& Pages;
  PageStretch Stretch;
  PagedArray<float>& Values;
  float Least;
  std::vector<Group> Groups;
  std::vector<std::uint32_t> GroupOf; ///< of the vertices of a run
};

} // namespace smg
