// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/Selection.h"

#include <vector>

namespace smg
{

/**
 * The vertices nearest to given points, found by a reading of the stream beforehand; of equally
 * near ones, the first in the stream. They are searched in batches by a k-d tree, which is only
 * built if the bounding box of the batch is nearer to some point than all vertices before. A batch
 * has at least m vertices: so this takes about (n + m) log(n) steps for m points and n vertices.
 */
class NearestSelection : public Selection
{
public:
  NearestSelection(const NearestVertices& nearest, DataPlace place, const std::string& key,
    const MeshColumns& columns);

  bool needsPreparing() const override { return !this->Distances.empty(); }
  void endPreparing(MeshParts* parts) override;

  /** The index of the point to which this selected vertex is nearest; the last one if there are
   * several. */
  std::size_t pointOf(std::int64_t vertex) const;

protected:
  void begin() override;
  void add(const MeshBlock& block, const std::filesystem::path& scratch) override;
  void select(const MeshBlock& block, std::span<std::uint8_t> selected) override;

private:
  /** Searches the vertices of the batch and empties it. */
  void searchBatch();

  std::vector<std::array<double, 3>> Points;
  std::vector<double> Batch;   ///< positions of vertices that have not been searched yet
  std::int64_t BatchBegin = 0; ///< stream index of the first vertex of the batch
  /** Squared distance of each point to the nearest vertex so far; empty after preparation. */
  std::vector<double> Distances;
  /** The nearest vertex so far to each point; after preparation ascending without duplicates. */
  std::vector<std::int64_t> Vertices;
  std::vector<std::size_t> Numbers; ///< after preparation: the point of each of these vertices
};

} // namespace smg
