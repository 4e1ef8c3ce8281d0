// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/PagedArray.h"
#include "IO/Order/Pages/PageStretch.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** Smooths values of paged vertices: each is replaced by the mean of its neighbours' values, vertex
 * by vertex. Vertices with a value below `least` are not changed. */
class VertexAveraging
{
public:
  /** All arguments must outlive this object. */
  VertexAveraging(VertexPages& pages, Workspace& workspace, PagedArray<float>& values, float least);

  /** Two sweeps over all vertices, from the first to the last and back. */
  void sweepVertices();

  /** The same, but the vertices of a patch among `run` consecutive ranks get a common value, the
   * mean outside: this smooths long waves, for which single vertices would need many sweeps. */
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
