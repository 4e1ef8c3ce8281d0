// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/InQuotes.h"
#include "IO/Import/Formats.h"
#include "IO/Import/VtkFallback.h"
#include "IO/Import/VtkMeshReader.h"
#include "IO/Import/VtkXmlLayout.h"
#include "IO/Import/VtkXmlPieces.h"
#include "Solver/Core/Error.h"

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
  if (needsVtk(layout))
  {
    importWithVtk(file, MeshFormat::VtkParallelXml, layout, builder, progress);
    return;
  }
  readVtkMesh(file, layout, builder, progress);
}

} // namespace smg
