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

/** Keeps the vertex columns of the vertices of a mesh stream that turn out to be wanted. */
class KeptRows
{
public:
  explicit KeptRows(const std::vector<ColumnSpec>& vertexColumns);

  /** Remembers the columns of the block's vertices. */
  void take(const MeshBlock& block);
  /** Forgets the vertices below `finalized` but for those that are kept. */
  void forgetBelow(std::int64_t finalized);

  /** Keeps a vertex that is not forgotten. */
  void keep(std::int64_t id);
  /** How many vertices are kept. */
  std::size_t size() const { return this->Kept.size(); }
  /** Keeps only the vertices for which `isWanted`. */
  void thin(const std::function<bool(std::int64_t)>& isWanted);

  /** The columns at the vertices `ids`, which are kept, a tuple each. */
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
