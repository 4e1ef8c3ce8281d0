// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

class vtkPointSet;

namespace smg
{

class KeptCoarserPreview;

/**
 * How far the values on a preview may be off, measured: by those on a coarser preview, a quarter of
 * its points. Where the error falls at least like the length of the edges, that of the preview is
 * the difference between both or less (Richardson's extrapolation); what no preview shows, as noise
 * that is smoothed, is in neither.
 */
class PreviewErrorEstimate
{
public:
  /** Solves on a mesh: fills the values at its points, and returns how many a point has. Throws
   * Error. */
  using Solve = std::function<int(vtkPointSet& mesh, std::vector<double>& values)>;

  /** Solves on a coarser preview of a preview of a surface, kept in `coarser`. It knows nothing if
   * that fails or the preview is too small. Throws Cancelled. */
  PreviewErrorEstimate(vtkPointSet& preview, KeptCoarserPreview& coarser, const Solve& solve);

  /** Says it of the values at the points of the preview, `columns` each, the first `compared` of
   * which count as a vector; "" if nothing is known. */
  std::string of(const std::vector<double>& values, int columns, int compared) const;

private:
  std::vector<std::int64_t> Points; ///< of the preview that the coarser one has
  std::vector<double> Values;       ///< on the coarser one
  int Columns = 0;
};

} // namespace smg
