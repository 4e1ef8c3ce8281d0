// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"

#include <cstdint>
#include <span>

namespace smg
{

/** Ranks of vertices, from `begin` to before `end`. */
struct RankRange
{
  std::int64_t begin, end;
  std::int64_t size() const { return this->end - this->begin; }
};

/** The cells of a mesh, distributed to groups of consecutive vertices of equal size. A cell is in
 * the group of each of its corners, so a group has all cells around its vertices. */
class CellGroups
{
public:
  /** The groups of the range have `groupVertices` vertices each; collecting uses `memory` bytes. */
  CellGroups(Workspace& workspace, RankRange range, std::int64_t groupVertices, std::size_t corners,
    std::int64_t memory);

  int groups() const { return this->Cells.buckets(); }
  RankRange range(int group) const;
  std::int64_t cells(int group) const
  {
    return this->Cells.bytes(group) / std::int64_t(this->Corners * sizeof(std::uint32_t));
  }

  /** Adds a cell, given the ranks of its corners, some of which may be outside the range. */
  void put(std::span<const std::uint32_t> cell)
  {
    std::uint32_t groups[4];
    for (std::size_t k = 0; k < this->Corners; ++k)
    {
      const std::uint32_t place = cell[k] - this->Begin;
      groups[k] = place < this->Size ? place / this->GroupVertices : None;
      bool isNew = groups[k] != None;
      for (std::size_t other = 0; other < k; ++other)
      {
        isNew = isNew && groups[other] != groups[k];
      }
      if (isNew)
      {
        this->Cells.append(static_cast<int>(groups[k]), std::as_bytes(cell));
      }
    }
  }
  /** To be called after the last put(). */
  void close() { this->Cells.close(); }

  /** Passes the cells of a group to `take`, in the order of put(). */
  template <class Take>
  void forEach(int group, Take&& take) const
  {
    const std::size_t bytes = this->Corners * sizeof(std::uint32_t);
    BucketFile::Reader reader(this->Cells, group);
    for (auto stretch = reader.next(bytes); !stretch.empty(); stretch = reader.next(bytes))
    {
      const auto* ranks = reinterpret_cast<const std::uint32_t*>(stretch.data());
      const std::size_t count = stretch.size() / sizeof(std::uint32_t);
      for (std::size_t i = 0; i < count; i += this->Corners)
      {
        take(std::span(ranks + i, this->Corners));
      }
    }
  }

private:
  static constexpr std::uint32_t None = ~std::uint32_t(0);

  std::size_t Corners;
  std::uint32_t Begin, Size, GroupVertices;
  BucketFile Cells;
};

} // namespace smg
