// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkStringArray.h"

#include <string>

namespace smg
{

/** The texts in the field array `name` of a mesh; null if there is none. */
inline vtkStringArray* fieldTexts(vtkPointSet& mesh, const char* name)
{
  return vtkStringArray::SafeDownCast(mesh.GetFieldData()->GetAbstractArray(name));
}

/** Appends to a copy of them, as other meshes may share the array. */
inline void appendFieldText(vtkPointSet& mesh, const char* name, const std::string& text)
{
  vtkNew<vtkStringArray> texts;
  if (vtkStringArray* before = fieldTexts(mesh, name))
  {
    texts->DeepCopy(before);
  }
  texts->SetName(name);
  texts->InsertNextValue(text);
  mesh.GetFieldData()->AddArray(texts);
}

} // namespace smg
