// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/VertexAveraging.h"

#include "IO/External/Relabelling.h"

#include <algorithm>

// Smoothing of one value per vertex, page by page along the curve: Gauss-Seidel for the graph
// Laplacian, forth and back. Values are in a paged array, and each sweep reads the adjacency of all
// pages twice, so the cost is linear, and one page is in memory. Sweeps over groups of vertices
// come first, since they smooth long waves, for which single vertices would need many sweeps.

namespace smg
{

VertexAveraging::VertexAveraging(
  VertexPages& pages, Workspace& workspace, PagedArray<float>& values, float least)
  : Pages(pages)
  , Stretch(pages, workspace)
  , Values(values)
  , Least(least)
{
}

/** Calls take(backwards) while each page is loaded, from the first to the last and back. */
template <class Take>
void VertexAveraging::forEachPageBothWays(Take&& take)
{
  const std::int64_t pages = this->Pages.pages();
  for (std::int64_t i = 0; i < 2 * pages; ++i)
  {
    const std::int64_t page = i < pages ? i : 2 * pages - 1 - i;
    if (i != pages) // else it is loaded already
    {
      this->Stretch.load(page, page + 1);
    }
    take(i >= pages);
  }
}

void VertexAveraging::sweepVertices()
{
  this->forEachPageBothWays(
    [&](bool backwards)
    {
      const std::uint32_t count = this->Stretch.end() - this->Stretch.first();
      for (std::uint32_t i = 0; i < count; ++i)
      {
        const std::uint32_t rank = this->Stretch.first() + (backwards ? count - 1 - i : i);
        // Vertices of components within a run have their final values, which are the lowest ones.
        if (this->Values.get(rank) < this->Least)
        {
          continue;
        }
        double sum = 0;
        int degree = 0;
        this->Stretch.neighbours(rank,
          [&](std::uint32_t other)
          {
            sum += this->Values.get(other);
            ++degree;
          });
        if (degree > 0)
        {
          this->Values.at(rank) = static_cast<float>(sum / degree);
        }
      }
    });
}

void VertexAveraging::sweepRuns(std::int64_t run, PagedArray<std::uint32_t>& patches)
{
  this->forEachPageBothWays(
    [&](bool backwards)
    {
      const std::int64_t first = this->Stretch.first(), end = this->Stretch.end();
      const std::int64_t runs = (end - first + run - 1) / run;
      for (std::int64_t i = 0; i < runs; ++i)
      {
        const std::int64_t begin = first + (backwards ? runs - 1 - i : i) * run;
        this->averageRun(std::uint32_t(begin), std::uint32_t(std::min(begin + run, end)), patches);
      }
    });
}

void VertexAveraging::averageRun(
  std::uint32_t begin, std::uint32_t end, PagedArray<std::uint32_t>& patches)
{
  this->Groups.clear();
  this->GroupOf.assign(end - begin, NoIndex);
  for (std::uint32_t rank = begin; rank < end; ++rank)
  {
    const std::uint32_t patch = patches.get(rank);
    if (patch == NoIndex)
    {
      continue;
    }
    // A run has few patches: a linear search suffices.
    auto group = std::ranges::find(this->Groups, patch, &Group::patch);
    if (group == this->Groups.end())
    {
      group = this->Groups.insert(group, { patch, 0, 0.0 });
    }
    this->GroupOf[rank - begin] = static_cast<std::uint32_t>(group - this->Groups.begin());
    this->Stretch.neighbours(rank,
      [&](std::uint32_t other)
      {
        // The mean over the edges that leave the group: inside it all values are to become the
        // same.
        if (other < begin || other >= end)
        {
          group->sum += this->Values.get(other);
          ++group->edges;
        }
      });
  }
  for (std::uint32_t rank = begin; rank < end; ++rank)
  {
    const std::uint32_t number = this->GroupOf[rank - begin];
    if (number != NoIndex && this->Groups[number].edges > 0)
    {
      this->Values.at(rank) =
        static_cast<float>(this->Groups[number].sum / this->Groups[number].edges);
    }
  }
}

} // namespace smg
