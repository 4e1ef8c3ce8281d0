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
#include "vtkUnsignedCharArray.h"

#include <cstddef>
#include <string>

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
  vtkAbstractArray* array = mesh.GetFieldData()->GetAbstractArray(MeshGroupsName);
  std::string text;
  if (auto* texts = vtkStringArray::SafeDownCast(array); texts && texts->GetNumberOfValues() > 0)
  {
    text = texts->GetValue(0);
  }
  else if (auto* characters = vtkUnsignedCharArray::SafeDownCast(array))
  {
    text.assign(reinterpret_cast<const char*>(characters->GetPointer(0)),
      static_cast<std::size_t>(characters->GetNumberOfValues()));
  }
  if (text.empty())
  {
    return {};
  }
  try
  {
    return groupsOfText(text);
  }
  catch (const MeshError& error)
  {
    throw Error(
      std::string("The input ") + error.what() + ", in its field array " + MeshGroupsName + '.');
  }
}

} // namespace smg
