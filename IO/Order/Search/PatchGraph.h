// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/PagedArray.h"
#include "IO/Order/Pages/PageStretch.h"
#include "IO/Order/Search/WeightedGraph.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace smg
{

/** The maximum size of the graph of patches. */
struct PatchLimits
{
  std::size_t nodes;
  std::size_t edges; ///< each counted at both nodes
};

/**
 * Cuts paged vertices into *patches*, the connected parts of runs of consecutive ranks, and makes
 * the graph of the patches: masses are vertices, weights are edges of the mesh. So the components
 * of this graph are those of the mesh. A component that lies in one run is no node of the graph:
 * its vertices get their values at once.
 */
class PatchGraph
{
public:
  /** Fills the arrays, by rank: `patches` with the patch, `values` with a position below closed()
   * for each vertex of a component within a run, whose patch is NoIndex. */
  PatchGraph(VertexPages& pages, Workspace& workspace, PagedArray<std::uint32_t>& patches,
    PagedArray<float>& values);

  /** Makes the graph from runs of `run` vertices. Returns false if it exceeds the limits. */
  bool build(std::int64_t run, const PatchLimits& limits);

  const WeightedGraph& graph() const { return this->Graph; }
  /** The number of vertices of components within a run. */
  std::int64_t closed() const { return this->Closed; }

private:
  /** Calls take(begin, end) for each run while it is loaded, until it returns false. */
  template <class Take>
  bool forEachRun(std::int64_t run, Take&& take);
  void label(std::uint32_t begin, std::uint32_t end);
  bool search(std::uint32_t start, std::uint32_t begin, std::uint32_t end, std::uint8_t mark);
  void connect(std::uint32_t begin, std::uint32_t end);

  VertexPages& Pages;
  PageStretch Stretch;
  PagedArray<std::uint32_t>& Patches;
  PagedArray<float>& Values;
  WeightedGraph Graph;
  std::int64_t Closed = 0;
  std::vector<std::uint32_t> Queue;
  std::vector<std::uint8_t> Marks; ///< of the vertices of a run
  std::vector<std::pair<std::uint32_t, std::uint32_t>> Crossing;
};

} // namespace smg
