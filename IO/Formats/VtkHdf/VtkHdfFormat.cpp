// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/VtkHdfFormat.h"

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkMeshReader.h"
#include "IO/Formats/VtkHdf/Hdf5File.h"
#include "IO/Formats/VtkHdf/VtkHdfLayout.h"
#include "IO/Formats/VtkHdf/WriteVtkHdf.h"
#include "IO/Raw/RawMeshBuilder.h"

#include <limits>

namespace smg
{

void importVtkHdf(InputFile& file, RawMeshBuilder& builder)
{
  const Hdf5File hdf(file.path(), file.name());
  VtkHdfLayout layout = vtkHdfLayout(hdf, builder.workspace().available() / 2);
  layout.files.front() = file.path();
  if (layout.timeSteps > 1)
  {
    builder.note("The file has " + std::to_string(layout.timeSteps) +
                 " time steps, of which the first is read.");
  }
  readVtkMesh(file, layout, builder);
}

namespace
{

bool isHdf5(std::string_view start)
{
  return start.starts_with("\x89HDF\r\n\x1a\n");
}

std::optional<FileCounts> countsOfVtkHdf(InputFile& file)
{
  const Hdf5File hdf(file.path(), file.name());
  const VtkHdfLayout layout = vtkHdfLayout(hdf, std::numeric_limits<std::int64_t>::max());
  FileCounts counts;
  counts.counted = true;
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
  counts.corners = counts.cells > 2 * counts.vertices ? 4 : 3;
  return counts;
}

WriteNotes write(const std::filesystem::path& vsm, const std::filesystem::path& path,
  const ProgressFunction& progress)
{
  return writeVtkHdf(vsm, path, progress);
}

constexpr FileSuffix VtkHdfSuffixes[] = { { ".vtkhdf" }, { ".hdf" } };

} // namespace

const Format VtkHdfFormat{
  .name = "VTKHDF",
  .suffixes = VtkHdfSuffixes,
  .attributes = "all columns",
  .hasSign = isHdf5,
  .parse = parseWith<importVtkHdf>,
  .counts = countsOfVtkHdf,
  .writeVsm = write,
};

} // namespace smg
