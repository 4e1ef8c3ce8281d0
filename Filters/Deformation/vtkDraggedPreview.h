// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Mesh/vtkCoarserPreview.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"
#include "vtkWeakPointer.h"

#include <cstdint>
#include <optional>
#include <vector>

class vtkPointSet;
class vtkPoints;

namespace smg
{

/** A preview, made coarser so that its deformation follows a dragged handle. */
class DraggedPreview
{
public:
  /** The preview if it has at most so many points or is no surface; else a coarser one with all
   * points of small handles, which is chosen once for as long as these and its points are the same.
   */
  vtkSmartPointer<vtkPointSet> of(vtkPointSet& preview, std::int64_t most);

private:
  std::optional<CoarserPreview> Coarser;
  vtkWeakPointer<vtkPoints> Points; ///< of the preview that it is of
  vtkMTimeType Time = 0;            ///< when they were changed
  std::vector<std::uint8_t> Small;
  std::int64_t Most = 0;
};

} // namespace smg
