// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/GroupData.h"

#include "IO/Files/InputFile.h"
#include "IO/Mesh/GroupsJson.h"
#include "IO/Vtk/FieldMarks.h"
#include "smg/Error.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

namespace smg
{

void addGroups(vtkDataObject& mesh, const MeshGroups& groups)
{
  if (!groups.empty())
  {
    vtkNew<vtkStringArray> text;
    text->SetName(MeshGroupsName);
    text->InsertNextValue(textOf(groups));
    addFieldArray(mesh, *text);
  }
}

MeshGroups groupsIn(vtkDataObject& mesh)
{
  auto* text = vtkStringArray::SafeDownCast(mesh.GetFieldData()->GetAbstractArray(MeshGroupsName));
  if (!text || text->GetNumberOfValues() == 0)
  {
    return {};
  }
  try
  {
    return groupsOfText(text->GetValue(0));
  }
  catch (const MeshError& error)
  {
    throw Error(
      std::string("The input ") + error.what() + ", in its field array " + MeshGroupsName + '.');
  }
}

} // namespace smg
