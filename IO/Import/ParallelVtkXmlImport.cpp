// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/InQuotes.h"
#include "IO/Import/Formats.h"
#include "IO/Import/VtkFallback.h"
#include "IO/Import/VtkMeshReader.h"
#include "IO/Import/VtkPointMerger.h"
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
    addVtkXmlLayout(piece, layout);
  }
  if (needsVtk(layout))
  {
    importWithVtk(file, MeshFormat::VtkParallelXml, layout, builder, progress);
    return;
  }
  if (layout.pieces.size() > 1 && !VtkPointMerger::applies(layout))
  {
    builder.note("The pieces of " + file.name() +
                 " have no global numbers of points (GlobalIds): points that pieces share stay "
                 "separate, and the mesh is open where pieces meet.");
  }
  readVtkMesh(file, layout, builder, progress);
}

} // namespace smg
