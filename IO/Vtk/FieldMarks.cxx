// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/FieldMarks.h"

#include "vtkAbstractArray.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

namespace smg
{

void addFieldArray(vtkDataObject& data, vtkAbstractArray& array)
{
  hide(array);
  data.GetFieldData()->AddArray(&array);
}

void addMark(vtkDataObject& data, const char* name, int components)
{
  vtkNew<vtkUnsignedCharArray> mark;
  mark->SetName(name);
  mark->SetNumberOfComponents(components);
  mark->SetNumberOfTuples(1);
  mark->Fill(1);
  addFieldArray(data, *mark);
}

void hide(vtkAbstractArray& array)
{
  array.GetInformation()->Set(vtkAbstractArray::GUI_HIDE(), 1);
}

} // namespace smg
