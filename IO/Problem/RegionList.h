// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Description/Region.h"
#include "Solver/Stream/MeshSource.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** A region of a file. */
struct NamedRegion
{
  Region region;
  /** What errors call it, as `dirichlet[1]` or `handles[2].region`. */
  std::string name;
};

/**
 * A file's regions over the vertices of a mesh stream. Vertices are named by the column OriginalId,
 * or by their stream index if the mesh has no such column.
 */
class RegionList
{
public:
  /** `mesh` is the mesh the regions are for. `file` is what errors call the file. */
  RegionList(std::vector<NamedRegion> regions, const StreamInfo& mesh, std::string file);

  /** The vertex columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const;

  /**
   * Reads the stream once and throws Error naming the region if a region selects no vertex, or
   * names a vertex that the mesh does not have.
   * @return how many vertices each region holds that no later one holds
   */
  std::vector<std::int64_t> check(MeshSource& mesh) const;

  /**
   * Calls `hold(i, k)` for each vertex i of the block and each region k that holds it, in the order
   * of the vertices, and of the regions for each: what the last call says of a vertex counts.
   * Throws Error if the block lacks a column that is needed.
   */
  template <class Hold>
  void visit(const MeshBlock& block, Hold hold) const
  {
    const Column* ids = this->idColumn(block);
    for (std::size_t i = 0; i < static_cast<std::size_t>(block.vertices()); ++i)
    {
      const std::int64_t id = idOf(block, ids, i);
      const std::span<const double, 3> point(block.positions.data() + 3 * i, 3);
      for (std::size_t k = 0; k < this->Regions.size(); ++k)
      {
        if (this->Regions[k].region.contains(point, id))
        {
          hold(i, k);
        }
      }
    }
  }

private:
  const Column* idColumn(const MeshBlock& block) const;
  /** The original number of vertex `i` of the block. */
  static std::int64_t idOf(const MeshBlock& block, const Column* ids, std::size_t i)
  {
    return ids ? ids->as<std::int64_t>()[i] : block.firstVertex + static_cast<std::int64_t>(i);
  }

  std::vector<NamedRegion> Regions;
  std::string File;
  bool HasIds = false; ///< whether the mesh has the column OriginalId
  bool ByName = false; ///< whether a region names its vertices
};

} // namespace smg
