// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <cstdint>
#include <span>
#include <vector>

class vtkPointSet;

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
  const std::vector<std::int64_t>& points() const { return this->Points; }
  /** The coarser mesh with the arrays of such a preview at its points, and its field data. */
  vtkSmartPointer<vtkPointSet> of(vtkPointSet& preview) const;

private:
  std::vector<std::int64_t> Points, Corners;
};

} // namespace smg
