// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/Selection.h"

#include <vector>

namespace smg
{

/**
 * The vertices nearest to given points, determined by a previous reading of the stream: of several
 * equally near ones, the first. The vertices are searched in batches by a k-d tree, which is only
 * built where the bounding box of the batch is nearer to a point than all vertices before: for m
 * points and n vertices about n log(batch) + m n / batch steps.
 */
class NearestSelection : public Selection
{
public:
  NearestSelection(const NearestVertices& nearest, DataPlace place, const std::string& key,
    const MeshColumns& columns);

  bool needsPreparing() const override { return !this->Distances.empty(); }
  void prepare(const MeshBlock& block, const std::filesystem::path& scratch) override;
  void endPreparing(MeshParts* parts) override;

  /** The number of the point to which a selected vertex is nearest, from 0; of several, the last
   * one. */
  std::size_t pointOf(std::int64_t vertex) const;

protected:
  void select(const MeshBlock& block, std::span<std::uint8_t> selected) override;

private:
  /** Searches the vertices of the batch and empties it. */
  void searchBatch();

  std::vector<std::array<double, 3>> Points;
  std::vector<double> Batch;   ///< positions of vertices that have not been searched yet
  std::int64_t BatchBegin = 0; ///< the first of them
  /** Squared, of the nearest vertex so far to each point; finally empty. */
  std::vector<double> Distances;
  std::vector<std::int64_t> Vertices; ///< those vertices; finally ascending without duplicates
  std::vector<std::size_t> Numbers;   ///< of the points of these, finally
};

} // namespace smg
