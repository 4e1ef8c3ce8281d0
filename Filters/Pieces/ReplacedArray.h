// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Vtk/FieldMarks.h"
#include "smg/ProblemDescription.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkStringArray.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkDataSetAttributes;
class vtkPointSet;

namespace smg
{

/** Adds an array that may replace one of its name. What that was to VTK, as the normals, the ids or
 * the texture coordinates of the mesh, the new array is not. */
void addResult(vtkDataSetAttributes& arrays, vtkAbstractArray& array);

/** Gives a point array of the mesh other values, in its type: integers are rounded to the nearest
 * one that the type holds. `values` has `stride` numbers a point; those of the array begin with
 * number `first`. Without such an array, as in a piece without points, nothing is done. Returns the
 * number of components of the array. */
std::size_t replaceArray(vtkPointSet& mesh, const std::string& name,
  const std::vector<double>& values, std::size_t first, std::size_t stride);

/**
 * The number of components of the point or cell array that a value names; `otherwise` if there is
 * none.
 */
int componentsOf(vtkPointSet& mesh, const DataValue& column, int otherwise);

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
  addFieldArray(mesh, *texts);
}

} // namespace smg
