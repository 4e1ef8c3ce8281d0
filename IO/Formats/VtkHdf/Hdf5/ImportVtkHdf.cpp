// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/Hdf5/ImportVtkHdf.h"

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkMeshReader.h"
#include "IO/Formats/VtkHdf/Hdf5/Hdf5File.h"
#include "IO/Formats/VtkHdf/Hdf5/VtkHdfLayout.h"
#include "IO/Raw/RawMeshBuilder.h"
#include "smg/Error.h"

#include <string>

namespace smg
{

namespace
{

/** For example "The file has 5 time steps, of which number 3, counted from 0, is read." */
std::string noteOn(std::int64_t count, const char* what, std::int64_t chosen)
{
  return "The file has " + std::to_string(count) + what + ", of which " +
         (chosen == 0 ? "the first" : "number " + std::to_string(chosen) + ", counted from 0,") +
         " is read.";
}

} // namespace

void importVtkHdf(InputFile& file, RawMeshBuilder& builder, const MeshPart& part)
{
  const Hdf5File hdf(file.path(), file.name());
  VtkHdfLayout layout = vtkHdfLayout(hdf, part, builder.workspace().available() / 2);
  layout.files.front() = file.path();
  builder.noteParts(layout.timeSteps, layout.partitions);
  if (layout.timeSteps > 1)
  {
    builder.note(noteOn(layout.timeSteps, " time steps", part.timeStep));
  }
  if (layout.isPart)
  {
    builder.note(noteOn(layout.partitions, " partitions", *part.partition));
  }
  readVtkMesh(file, layout, builder);
}

namespace
{

FileCounts readCounts(InputFile& file, const MeshPart& part)
{
  const Hdf5File hdf(file.path(), file.name());
  constexpr std::int64_t MostBytes = std::int64_t(16) << 20;
  const VtkHdfLayout layout = vtkHdfLayout(hdf, part, MostBytes);
  FileCounts counts;
  // Points shared by partitions are counted in each.
  counts.counted = layout.pieces.size() == 1;
  for (const VtkPiece& piece : layout.pieces)
  {
    counts.vertices += piece.points;
    counts.cells += piece.cells;
    for (const auto* arrays : { &piece.pointArrays, &piece.cellArrays })
    {
      for (const VtkArray& array : *arrays)
      {
        counts.columnBytes += array.values * static_cast<std::int64_t>(sizeOf(array.type));
      }
    }
  }
  // A surface has about two triangles per vertex, a solid five to six tetrahedra.
  counts.corners = counts.cells > 3 * counts.vertices ? 4 : 3;
  return counts;
}

} // namespace

std::optional<FileCounts> countsOfVtkHdf(InputFile& file, const MeshPart& part)
{
  try
  {
    return readCounts(file, part);
  }
  catch (const Error&)
  {
    // Errors are reported when the mesh is read.
    return {};
  }
}

} // namespace smg
