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

/** The gradients that blend() aims at in cells between patches. */
enum class SeamGradient
{
  Zero, ///< 0: the steps vanish as far as possible
  /**
   * The mean of the gradients on both sides: over the cells around the corners that lie in one
   * patch, weighted by area or volume, one that has several of the corners as often; 0 if there is
   * none. A linear function that each patch records with an offset is restored up to a constant.
   */
  Average
};

/**
 * What blend() does: it removes the steps of columns between patches and keeps their gradients
 * inside the patches.
 *
 *     BlendDescription colours;
 *     colours.patch = "scan";
 *     colours.columns = { "Colors" };
 */
struct BlendDescription
{
  /** Largest number of components of all columns together. */
  static constexpr int MaxComponents = 64;

  /** Name of the column of one component with the patch of each vertex, or of each cell. Any
   * numbers name patches; integers must be below 2^53 in magnitude. With a column of the cells,
   * vertices where cells of several patches meet are in no patch. If vertices and cells have a
   * column of this name, that of the vertices counts. */
  std::string patch;
  /** Names of the vertex columns that are blended, of any numeric type. */
  std::vector<std::string> columns;
  /** Parts of the mesh that keep their values. */
  std::vector<Where> hold;
  /**
   * How strongly all values are pulled towards the original ones, at least 0: the weight of the
   * squared differences over that of the squared gradients, in units of 1 / diagonal^2, with the
   * diagonal of the mesh's bounding box. Corrections that vary over less than 1 / sqrt(anchor)
   * diagonals are hardly pulled: with the default, ten diagonals, the anchor determines little but
   * the mean. 0, and less than 1e-8: only the mean of each component without held vertices is that
   * of the original.
   */
  double anchor = 0.01;
  SeamGradient seam = SeamGradient::Zero; ///< the gradients between patches
};

/**
 * The columns of a mesh that are blended, in the order of the solution's columns.
 * @throws Error if the mesh lacks a column, or the description is not valid
 */
SMG_EXPORT std::vector<ColumnSpec> blendedColumns(
  const StreamInfo& mesh, const BlendDescription& description);

/**
 * Blends columns in the gradient domain, out of core: the new values u minimise, over the piecewise
 * linear functions, the integral of |grad u - q|^2 + s |u - c|^2, where c are the original values,
 * s is `anchor` / diagonal^2, and q is grad c in cells whose corners are all in one patch, 0 or the
 * mean of the gradients around in all others (Perez, Gangnet and Blake 2003; on meshes Chuang et
 * al. 2009).
 * @param mesh the mesh, read three times, and once more for SeamGradient::Average
 * @param description what is blended
 * @param options how to solve; the tolerance refers to the correction u - c, and the memory limit
 * includes what the blending holds at the vertices that later cells may use
 * @return u: the components of blendedColumns(), not rounded to the types of the columns (see
 * ReplacedColumns). Report::seams has the largest steps before and after. Without an edge between
 * patches u is c exactly.
 * @throws Error if the description is not valid, a value or a patch is not a number, a held part is
 * empty, and as solve()
 * @throws Cancelled if the progress callback returns false
 */
SMG_EXPORT std::unique_ptr<Solution> blend(
  const StoredMesh& mesh, const BlendDescription& description, const SolveOptions& options = {});

} // namespace smg
