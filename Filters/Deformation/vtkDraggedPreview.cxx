// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/vtkDraggedPreview.h"

#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <utility>

namespace smg
{

vtkSmartPointer<vtkPointSet> DraggedPreview::of(vtkPointSet& preview, std::int64_t most)
{
  if (preview.GetNumberOfPoints() <= most || !CoarserPreview::isPossible(preview))
  {
    this->Coarser.reset();
    return &preview;
  }
  std::vector<std::uint8_t> small = smallPatches(preview);
  vtkPoints* points = preview.GetPoints();
  if (!this->Coarser || this->Points != points || this->Time != points->GetMTime() ||
      this->Small != small || this->Most != most)
  {
    this->Coarser.emplace(preview, most, small);
    this->Points = points;
    this->Time = points->GetMTime();
    this->Small = std::move(small);
    this->Most = most;
  }
  return this->Coarser->of(preview);
}

} // namespace smg
