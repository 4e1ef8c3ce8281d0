// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Pieces/ReplacedArray.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>

namespace smg
{

namespace
{

/** Rounds values to the type of an array. */
class Rounding
{
public:
  explicit Rounding(vtkDataArray& array)
    : IsReal(array.GetDataType() == VTK_FLOAT || array.GetDataType() == VTK_DOUBLE)
    , Least(array.GetDataTypeMin())
    , Most(array.GetDataTypeMax())
  {
    // The largest number of a 64-bit type is not a double, and the next one above it not of the
    // type.
    this->Most = this->Most >= 0x1p63 ? std::nextafter(this->Most, 0.0) : this->Most;
  }

  double operator()(double value) const
  {
    return this->IsReal ? value : std::clamp(std::nearbyint(value), this->Least, this->Most);
  }

private:
  bool IsReal;
  double Least, Most;
};

} // namespace

/** Colours and arrows can be drawn of any numbers and of any vectors. */
void addResult(vtkDataSetAttributes& arrays, vtkAbstractArray& array)
{
  arrays.AddArray(&array);
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    const bool isDrawn =
      type == vtkDataSetAttributes::SCALARS ||
      (type == vtkDataSetAttributes::VECTORS && array.GetNumberOfComponents() == 3);
    if (arrays.GetAbstractAttribute(type) == &array && !isDrawn)
    {
      arrays.SetActiveAttribute(-1, type);
    }
  }
}

std::size_t replaceArray(vtkPointSet& mesh, const std::string& name,
  const std::vector<double>& values, std::size_t first, std::size_t stride)
{
  vtkDataArray* before = mesh.GetPointData()->GetArray(name.c_str());
  if (!before)
  {
    return 0;
  }
  const auto after = vtkSmartPointer<vtkDataArray>::Take(before->NewInstance());
  after->SetName(before->GetName());
  after->SetNumberOfComponents(before->GetNumberOfComponents());
  after->CopyComponentNames(before);
  // Points of no cell keep what they have; not as double, which cannot hold all integers.
  after->InsertTuples(0, before->GetNumberOfTuples(), 0, before);
  const Rounding rounded(*before);
  for (vtkIdType i = 0; i < after->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < after->GetNumberOfComponents(); ++k)
    {
      const std::size_t place = static_cast<std::size_t>(i) * stride + first;
      const double value = values[place + static_cast<std::size_t>(k)];
      if (!std::isnan(value))
      {
        after->SetComponent(i, k, rounded(value));
      }
    }
  }
  mesh.GetPointData()->AddArray(after);
  return static_cast<std::size_t>(after->GetNumberOfComponents());
}

int componentsOf(vtkPointSet& mesh, const DataValue& column, int otherwise)
{
  vtkDataArray* ofPoints = mesh.GetPointData()->GetArray(column.column()->c_str());
  vtkDataArray* ofCells = mesh.GetCellData()->GetArray(column.column()->c_str());
  const bool prefersCells = column.owner() == DataValue::Owner::Cells;
  vtkDataArray* array = ofCells && (prefersCells || !ofPoints) ? ofCells : ofPoints;
  return array ? array->GetNumberOfComponents() : otherwise;
}

} // namespace smg
