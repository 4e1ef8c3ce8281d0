// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Preview/SurfaceBinding.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"
#include "vtkWeakPointer.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

class vtkPointSet;
class vtkPoints;

namespace smg
{

/** Of each point of a surface: whether it is of a small patch, of at most 64 points, of those that
 * masks of handles, conditions and regions mark (unsigned char arrays of one component): these
 * could vanish in a coarser mesh. */
std::vector<std::uint8_t> smallPatches(vtkPointSet& surface);

/** Some points of a preview that is a surface, with coarser triangles. */
class CoarserPreview
{
public:
  /** Whether a preview can be made coarser: it is a surface. */
  static bool isPossible(vtkPointSet& preview);

  /** At most so many points, besides the `locked` ones: those whose entry is not 0. */
  CoarserPreview(vtkPointSet& preview, std::int64_t most, std::span<const std::uint8_t> locked);

  /** The numbers of its points in the preview. */
  const std::vector<std::int64_t>& points() const { return this->Surface.vertices; }
  const CoarserSurface& surface() const { return this->Surface; }
  /** The coarser mesh with the arrays of such a preview at its points, and its field data. */
  vtkSmartPointer<vtkPointSet> of(vtkPointSet& preview) const;

private:
  CoarserSurface Surface;
  vtkSmartPointer<vtkPoints> Places; ///< the same in all meshes, so that these can be recognised
};

/** A coarser preview with all points of small patches, made once for as long as the points and the
 * number of cells of the preview and these patches are the same: not whenever the motion of a
 * handle changes. */
class KeptCoarserPreview
{
public:
  /** Of at most so many points besides those of small patches. */
  const CoarserPreview& of(vtkPointSet& preview, std::int64_t most);

  /** Replaces the positions of the points of the last one, in rows of `columns` numbers, by those
   * of all points of its preview, which follow them (SurfaceBinding), or are where handles hold
   * them; with six columns, their normals are behind them. */
  void follow(vtkPointSet& preview, int columns, std::vector<double>& rows);

private:
  std::optional<SurfaceBinding> Binding; ///< of the preview to the coarser one, once it is needed
  std::optional<CoarserPreview> Coarser;
  vtkWeakPointer<vtkPoints> Points; ///< of the preview that it is of
  vtkMTimeType Time = 0;            ///< when they were changed
  vtkIdType Cells = 0;              ///< of the preview
  std::vector<std::uint8_t> Small;
  std::int64_t Most = 0;
};

} // namespace smg
