// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <unordered_map>
#include <vector>

namespace smg
{

/** Keeps the vertex columns of selected vertices of a mesh stream. */
class KeptRows
{
public:
  explicit KeptRows(const std::vector<ColumnSpec>& vertexColumns);

  /** Stores the columns of the vertices of the block. */
  void take(const MeshBlock& block);
  /** Releases the vertices below `finalized` except those that are kept. */
  void forgetBelow(std::int64_t finalized);

  /** Keeps a vertex that has not been released. */
  void keep(std::int64_t id);
  /** The number of kept vertices. */
  std::size_t size() const { return this->Kept.size(); }
  /** Keeps only the vertices with `isWanted`. */
  void thin(const std::function<bool(std::int64_t)>& isWanted);

  /** The columns at the kept vertices `ids`, one tuple per vertex. */
  std::vector<Column> gather(const std::vector<std::int64_t>& ids) const;

private:
  struct Block
  {
    std::int64_t first, end; ///< stream indices of its vertices
    std::vector<Column> columns;
  };

  std::vector<ColumnSpec> Specs;
  std::deque<Block> Window;
  std::unordered_map<std::int64_t, std::vector<std::byte>> Kept; ///< the tuples, one after another
};

} // namespace smg
