// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/External/Workspace.h"
#include "IO/Import/RawMesh.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Passes all of `numbers` to `take`, in consecutive ranges, each a multiple of `count`. */
template <class Take>
void forEachStretch(const RecordFile<std::uint32_t>& numbers, std::size_t count, Take&& take)
{
  const std::size_t most = (std::size_t(16) << 10) / count * count;
  std::vector<std::uint32_t> stretch;
  RecordFile<std::uint32_t>::Reader reader(numbers);
  for (std::int64_t left = numbers.size(); left > 0;
       left -= static_cast<std::int64_t>(stretch.size()))
  {
    stretch.resize(std::min(most, static_cast<std::size_t>(left)));
    reader.next(stretch);
    take(std::span<const std::uint32_t>(stretch));
  }
}

/** Passes the vertices of the mesh to `take`: the number, and the three coordinates as `Real`. */
template <class Real, class Take>
void forEachVertex(const RawMesh& mesh, Take&& take)
{
  constexpr std::size_t bytes = 3 * sizeof(Real);
  BucketFile::Reader reader(mesh.positions);
  std::uint32_t vertex = 0;
  for (auto stretch = reader.next(bytes); !stretch.empty(); stretch = reader.next(bytes))
  {
    const Real* position = reinterpret_cast<const Real*>(stretch.data());
    for (std::size_t i = 0; i < stretch.size() / bytes; ++i)
    {
      take(vertex++, position + 3 * i);
    }
  }
}

/** Determines which vertices of a mesh occur in a cell: a bit per vertex, for as many vertices at a
 * time as the memory permits, with a pass over the cells for each range. */
class UsedVertices
{
public:
  /** The bits use at most `memory` bytes. Mesh and workspace must outlive this object. */
  UsedVertices(const RawMesh& mesh, Workspace& workspace, std::int64_t memory)
    : Mesh(mesh)
    , Range(
        (std::clamp<std::int64_t>(memory * 8, 64, std::max<std::int64_t>(mesh.vertices, 64)) + 63) /
        64 * 64)
    , First(-this->Range)
    , Bits(workspace.pool(), static_cast<std::size_t>(this->Range / 8))
  {
  }

  /** Vertices should be asked for in ascending order, since a step back may require a pass over the
   * cells. */
  bool contains(std::uint32_t vertex)
  {
    if (std::int64_t(vertex) - this->First >= this->Range || vertex < this->First)
    {
      // Ranges begin at multiples of their size, so a range is loaded once if vertices are asked
      // for in order.
      this->load(vertex / this->Range * this->Range, [](std::uint64_t, std::uint32_t) {});
    }
    const auto place = static_cast<std::uint32_t>(vertex - this->First);
    return (this->words()[place / 64] >> place % 64 & 1) != 0;
  }

  /** Calls `take` with the number of the corner in the file, and the vertex, for the first use of
   * each; range by range in the order of the corners. */
  template <class Take>
  void forEachFirstUse(Take&& take)
  {
    for (std::int64_t first = 0; first < this->Mesh.vertices; first += this->Range)
    {
      this->load(first, take);
    }
  }

private:
  template <class Take>
  void load(std::int64_t first, Take&& take)
  {
    this->First = first;
    std::uint64_t* const words = this->words();
    std::fill_n(words, this->Range / 64, 0);
    std::uint64_t number = 0;
    forEachStretch(this->Mesh.corners, 1,
      [&](std::span<const std::uint32_t> corners)
      {
        for (const std::uint32_t corner : corners)
        {
          // Unsigned: a corner below the range becomes a large number, too.
          const std::uint32_t place = corner - static_cast<std::uint32_t>(first);
          if (place < this->Range)
          {
            std::uint64_t& word = words[place / 64];
            const std::uint64_t bit = std::uint64_t(1) << place % 64;
            if ((word & bit) == 0)
            {
              word |= bit;
              take(number, corner);
            }
          }
          ++number;
        }
      });
  }
  std::uint64_t* words() const { return reinterpret_cast<std::uint64_t*>(this->Bits.data()); }

  const RawMesh& Mesh;
  std::int64_t Range;
  std::int64_t First; ///< the first vertex of the bits
  Buffer Bits;
};

/** A vertex in the order of the ranks. */
template <class Real>
struct RankedVertex
{
  Real position[3];
  std::uint32_t id; ///< number in the raw mesh
};

/**
 * Sorts the used vertices by their keys, and vertices with equal keys by their numbers, in `memory`
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
