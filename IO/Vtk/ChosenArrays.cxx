// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/ChosenArrays.h"

#include "IO/Mesh/Columns.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPassInputTypeAlgorithm.h"
#include "vtkPointData.h"

namespace smg
{
namespace
{

void keep(vtkDataSetAttributes& arrays, const std::set<std::string>& names)
{
  for (int k = arrays.GetNumberOfArrays() - 1; k >= 0; --k)
  {
    const char* name = arrays.GetArrayName(k);
    const bool isKept =
      name && (names.contains(name) || isContractArray(name) || std::string(CellFlagsName) == name);
    if (!isKept && arrays.GetArray(k) != arrays.GetGlobalIds())
    {
      arrays.RemoveArray(k);
    }
  }
}

class vtkChosenArrays : public vtkPassInputTypeAlgorithm
{
public:
  static vtkChosenArrays* New() { VTK_STANDARD_NEW_BODY(vtkChosenArrays); }
  vtkTypeMacro(vtkChosenArrays, vtkPassInputTypeAlgorithm);

  ArrayChoice Choice;

protected:
  int FillInputPortInformation(int, vtkInformation* info) override
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
    return 1;
  }

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    vtkDataSet* mesh = vtkDataSet::GetData(outputs);
    mesh->ShallowCopy(vtkDataSet::GetData(inputs[0]));
    keep(*mesh->GetPointData(), this->Choice.points);
    keep(*mesh->GetCellData(), this->Choice.cells);
    return 1;
  }
};

} // namespace

vtkSmartPointer<vtkAlgorithm> passChosenArrays(vtkAlgorithmOutput* input, const ArrayChoice& choice)
{
  const auto filter = vtkSmartPointer<vtkChosenArrays>::New();
  filter->Choice = choice;
  filter->SetInputConnection(input);
  return filter;
}

} // namespace smg
