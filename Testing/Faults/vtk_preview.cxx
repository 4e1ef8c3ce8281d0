// SPDX-License-Identifier: BSD-3-Clause
// A preview in a pipeline of VTK: vtk_preview reader|filter MESH.vsm PREVIEW.obj
//   reader: the answer of vtkStreamingMeshReader to a request for a whole mesh that is too large
//   filter: vtkStreamingMeshPreview
// The result is written only if there is one: a view would get an empty one with the array
// `Failed`.
#include "vtkStreamingMeshPreview.h"
#include "vtkStreamingMeshReader.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <cstdio>
#include <iostream>
#include <new>
#include <string>

namespace
{

/** Returns whether there is a preview; writes its points and triangles. Writers of VTK would write
 * a part of it where memory ends. */
bool write(vtkAlgorithm& preview, const char* name)
{
  preview.Update();
  auto* const mesh = vtkPolyData::SafeDownCast(preview.GetOutputDataObject(0));
  if (!mesh || mesh->GetFieldData()->HasArray("Failed"))
  {
    // The algorithms have reported the error.
    return false;
  }
  mesh->BuildCells();
  std::FILE* const file = std::fopen(name, "w");
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double point[3];
    mesh->GetPoint(i, point);
    std::fprintf(file, "v %.17g %.17g %.17g\n", point[0], point[1], point[2]);
  }
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    mesh->GetCellPoints(i, count, corners);
    std::fprintf(file, "f");
    for (vtkIdType k = 0; k < count; ++k)
    {
      std::fprintf(file, " %lld", static_cast<long long>(corners[k]) + 1);
    }
    std::fprintf(file, "\n");
  }
  return std::fclose(file) == 0;
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 4)
  {
    std::cerr << "usage: vtk_preview reader|filter MESH.vsm PREVIEW.obj\n";
    return 2;
  }
  try
  {
    vtkNew<vtkStreamingMeshReader> reader;
    reader->SetFileName(argv[2]);
    reader->SetMaximumPointsInMemory(0);
    reader->SetPreviewPoints(500);
    vtkNew<vtkStreamingMeshPreview> preview;
    preview->SetInputConnection(reader->GetOutputPort());
    preview->SetPreviewPoints(500);
    const bool isReader = std::string(argv[1]) == "reader";
    return write(isReader ? static_cast<vtkAlgorithm&>(*reader) : *preview, argv[3]) ? 0 : 1;
  }
  catch (const std::bad_alloc&)
  {
    std::cerr << "ERR| VTK itself has no memory.\n";
    return 1;
  }
}
