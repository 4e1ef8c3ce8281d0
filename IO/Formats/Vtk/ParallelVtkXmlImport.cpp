// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InQuotes.h"
#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Formats/Vtk/VtkMeshReader.h"
#include "IO/Formats/Vtk/VtkXmlLayout.h"
#include "IO/Formats/Vtk/VtkXmlPieces.h"
#include "IO/Raw/RawMeshBuilder.h"
#include "smg/Error.h"

#include <filesystem>
#include <system_error>

namespace smg
{

void importParallelVtkXml(
  InputFile& file, RawMeshBuilder& builder, const ProgressFunction& progress)
{
  const std::int64_t mostBytes = builder.workspace().available() / 2;
  VtkLayout layout;
  for (const std::filesystem::path& path : vtkXmlPieceFiles(file))
  {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
    {
      throw Error(file.name() + ": the piece " + inQuotes(path.string()) +
                  " that the file names does not exist.");
    }
    InputFile piece(path);
    addVtkXmlLayout(piece, layout, mostBytes);
  }
  readVtkMesh(file, layout, builder, progress);
}

} // namespace smg
