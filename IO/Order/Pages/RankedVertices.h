// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/Order/Pages/RawMeshPass.h"
#include "IO/Order/Pages/UsedVertices.h"

#include <algorithm>
#include <cstdint>

namespace smg
{

/** A vertex in the order of the ranks. */
template <class Real>
struct RankedVertex
{
  Real position[3];
  std::uint32_t id; ///< number in the raw mesh
};

/**
 * Sorts the used vertices by their keys, and those of equal keys by their numbers, in `memory`
 * bytes. The position of each is its rank, which is stored in `ranks`.
 *
 * @param key returns the key of a vertex; called in ascending order of the numbers with the number
 * and the coordinates
 */
template <class Real, class Key>
RecordFile<RankedVertex<Real>> rankVertices(const RawMesh& mesh, Workspace& workspace,
  UsedVertices& used, std::int64_t memory, Key&& key, Relabelling& ranks)
{
  struct KeyedVertex
  {
    std::uint64_t key;
    RankedVertex<Real> vertex;
    bool operator<(const KeyedVertex& other) const
    {
      return this->key < other.key || (this->key == other.key && this->vertex.id < other.vertex.id);
    }
  };
  ExternalSort<KeyedVertex> sort(workspace, memory);
  forEachVertex<Real>(mesh,
    [&](std::uint32_t id, const Real* position)
    {
      if (used.contains(id))
      {
        sort.put({ key(id, position), { { position[0], position[1], position[2] }, id } });
      }
    });
  sort.sort();
  RecordFile<RankedVertex<Real>> ranked(workspace);
  std::uint32_t rank = 0;
  for (KeyedVertex next; sort.next(next); ++rank)
  {
    ranks.put(next.vertex.id, rank);
    ranked.put(next.vertex);
  }
  ranked.close();
  return ranked;
}

} // namespace smg
