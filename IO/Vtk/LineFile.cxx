// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/LineFile.h"

#include "IO/Files/FileNames.h"
#include "IO/Results/PathFile.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Error.h"
#include "smg/Report.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataWriter.h"
#include "vtkSmartPointer.h"
#include "vtkXMLPolyDataWriter.h"

#include <string>
#include <vector>

namespace smg
{
namespace
{

std::vector<Report::Path> pathsOf(vtkPolyData& lines)
{
  std::vector<Report::Path> paths;
  const auto line = vtk::TakeSmartPointer(lines.GetLines()->NewIterator());
  for (line->GoToFirstCell(); !line->IsDoneWithTraversal(); line->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    line->GetCurrentCell(size, points);
    Report::Path& path = paths.emplace_back();
    for (vtkIdType k = 0; k < size; ++k)
    {
      lines.GetPoint(points[k], path.points.emplace_back().data());
    }
  }
  return paths;
}

/** With a writer of VTK, which writes in place. */
template <class Writer>
void writeWith(Writer& writer, vtkPolyData& lines, const std::filesystem::path& path)
{
  const ScratchFolder scratch(std::filesystem::absolute(path).parent_path());
  const std::filesystem::path complete = scratch.path() / path.filename();
  writer.SetInputData(&lines);
  writer.SetFileName(complete.c_str());
  if (writer.Write() == 0)
  {
    throw Error(path.string() + " could not be written.");
  }
  std::filesystem::rename(complete, path);
}

} // namespace

void checkLineFile(const std::filesystem::path& path)
{
  const std::string suffix = lowerSuffix(path);
  if (suffix != ".vtp" && suffix != ".vtk" && suffix != ".obj")
  {
    throw Error(path.string() + ": lines are written as .vtp, .vtk and .obj files.");
  }
}

void writeLines(vtkPolyData& lines, const std::filesystem::path& path, bool text)
{
  checkLineFile(path);
  const std::string suffix = lowerSuffix(path);
  if (suffix == ".obj")
  {
    writePaths(path, pathsOf(lines));
  }
  else if (suffix == ".vtk")
  {
    const vtkNew<vtkPolyDataWriter> writer;
    text ? writer->SetFileTypeToASCII() : writer->SetFileTypeToBinary();
    writeWith(*writer, lines, path);
  }
  else
  {
    const vtkNew<vtkXMLPolyDataWriter> writer;
    writeWith(*writer, lines, path);
  }
}

} // namespace smg
