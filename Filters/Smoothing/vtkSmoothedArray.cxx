// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Smoothing/vtkSmoothedArray.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>

namespace smg
{

void replaceArray(vtkPointSet& piece, const std::string& name, const std::vector<double>& values,
  vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  vtkDataArray* before = piece.GetPointData()->GetArray(name.c_str());
  if (!before)
  {
    return; // a piece without points need not have arrays
  }
  const auto after = vtkSmartPointer<vtkDataArray>::Take(before->NewInstance());
  after->SetName(before->GetName());
  after->SetNumberOfComponents(before->GetNumberOfComponents());
  after->SetNumberOfTuples(before->GetNumberOfTuples());
  after->CopyComponentNames(before);
  const bool isReal = before->GetDataType() == VTK_FLOAT || before->GetDataType() == VTK_DOUBLE;
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    const auto components = static_cast<std::size_t>(before->GetNumberOfComponents());
    const double value = isReal ? values[k]
                                : std::clamp(std::nearbyint(values[k]), before->GetDataTypeMin(),
                                    before->GetDataTypeMax());
    after->SetComponent(
      static_cast<vtkIdType>(k / components), static_cast<int>(k % components), value);
  }
  output.GetPointData()->AddArray(after);
}

} // namespace smg
