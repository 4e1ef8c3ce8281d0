// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InQuotes.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/NearbyFile.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Formats/Vtk/VtkMeshReader.h"
#include "IO/Formats/Vtk/VtkXmlLayout.h"
#include "IO/Formats/Vtk/VtkXmlRoot.h"
#include "IO/Import/RawMeshBuilder.h"
#include "smg/Error.h"

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace smg
{

namespace
{

/** The names of the pieces are held in memory. */
constexpr std::size_t MostPieces = 100000;

/** The files that a .pvtp or .pvtu file names. Throws Error if it is none. */
std::vector<std::filesystem::path> pieceFiles(InputFile& file)
{
  XmlTags tags(file);
  const XmlTag root = vtkXmlRoot(file, tags);
  const std::string kind = root.value("type");
  if (kind != "PPolyData" && kind != "PUnstructuredGrid")
  {
    file.fail(root.begin, "the file names no pieces of polygonal data or of an unstructured grid "
                          "of VTK, which are the kinds that hold meshes");
  }
  // Beside the file that the user knows, of which this one may be the inflated one.
  const std::filesystem::path folder = std::filesystem::path(file.name()).parent_path();
  std::vector<std::filesystem::path> files;
  for (XmlTag tag; tags.next(tag);)
  {
    if (tag.name == "Piece" && !tag.closes)
    {
      const std::string source = tag.value("Source");
      if (source.empty())
      {
        file.fail(tag.begin, "the piece here has no Source: the file is damaged");
      }
      if (files.size() == MostPieces)
      {
        file.fail(tag.begin,
          "there are more than " + std::to_string(MostPieces) + " pieces, which are too many");
      }
      if (nearbyFile(folder, source).empty())
      {
        file.fail(tag.begin, "the piece " + inQuotes(source) +
                               " is not in the folder of the file or below: only such "
                               "files are read");
      }
      files.push_back(folder / source);
    }
  }
  if (files.empty())
  {
    file.fail(root.begin, "the file names no pieces");
  }
  return files;
}

} // namespace

void importParallelVtkXml(
  InputFile& file, RawMeshBuilder& builder, const ProgressFunction& progress)
{
  const std::int64_t mostBytes = builder.workspace().available() / 2;
  VtkLayout layout;
  for (const std::filesystem::path& path : pieceFiles(file))
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
