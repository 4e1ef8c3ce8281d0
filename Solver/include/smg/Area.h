// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Region.h"
#include "smg/Solve.h"

#include <memory>
#include <string>
#include <vector>

namespace smg
{

/** Vertex column with the share of each vertex in the area of a surface (float64). */
inline constexpr const char* AreaName = "Area";
/** The same of the volume of a tetrahedral mesh. */
inline constexpr const char* VolumeName = "Volume";

/** How a cell is shared among its vertices. */
enum class AreaShare
{
  Equal, ///< the same to each: the lumped mass of linear finite elements
  /** Of triangles, what is nearer to a vertex than to the others; of an obtuse one half to that
   * corner and a quarter to each of the others (Meyer, Desbrun, Schroeder and Barr 2003). */
  Voronoi
};

/** What area() sums up. */
struct AreaDescription
{
  /** Column of the cells of one component by whose values areas are summed; empty: only the total.
   * It may have MaxTags values. */
  std::string tag;
  /** Parts of the mesh: a cell counts if all of its corners lie in one of them; a column of the
   * cells selects cells. Empty: all cells count. */
  std::vector<Where> of;
  AreaShare share = AreaShare::Equal; ///< what vertices have of their cells
  /** By which lengths are multiplied, above 0: 0.001 for a mesh in millimetres and areas in square
   * metres. */
  double scale = 1.0;

  /** The largest number of tags. */
  static constexpr std::size_t MaxTags = 65536;
};

/** The column of a mesh that area() computes: Area or Volume. */
SMG_EXPORT ColumnSpec areaColumn(const StreamInfo& mesh);

/**
 * The area of a surface, or the volume of a tetrahedral mesh: of each vertex, by tags of the cells,
 * and in all. Cells that are flagged or use a vertex twice have none; tetrahedra that are inverted
 * count like others.
 * @param mesh the mesh, read once, and once more before if parts of it are named
 * @param description what is summed up
 * @param options the memory limit, scratch files, whether to use none (`inCore`), progress
 * @param name what error messages call the description
 * @return areaColumn() at the vertices; Report::areas has the sums
 * @throws Error if the mesh lacks the column, a tag is not a number, a part has no cell, an
 * option is out of range, and if memory or scratch files do not suffice
 * @throws Cancelled if the progress callback returns false
 */
SMG_EXPORT std::unique_ptr<Solution> area(const StoredMesh& mesh,
  const AreaDescription& description = {}, const SolveOptions& options = {},
  const std::string& name = "area");

} // namespace smg
