// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkFormats.h"

#include "IO/Files/FileNames.h"
#include "IO/Files/Inflate.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/TextScanner.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Formats/Vtk/XmlTags.h"
#include "IO/Import/RawMeshBuilder.h"
#include "smg/Error.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace smg
{

namespace
{

bool isLegacyVtk(std::string_view start)
{
  return textStart(start).starts_with("# vtk DataFile");
}

/** The type in the element VTKFile; none if its tag does not end in these bytes. */
std::optional<std::string_view> typeOfXml(std::string_view start)
{
  const std::string_view text = textStart(start);
  const std::size_t at = text.find("<VTKFile");
  if (!text.starts_with('<') || at == std::string_view::npos)
  {
    return {};
  }
  const std::size_t end = text.find('>', at);
  if (end == std::string_view::npos)
  {
    return {}; // it goes on behind these bytes
  }
  const std::string_view tag = text.substr(at, end - at);
  const std::size_t type = tag.find(" type=");
  constexpr std::size_t beforeValue = 7; // blank, name, equals sign and quotation mark
  return tag.substr(
    type == std::string_view::npos ? tag.size() : std::min(type + beforeValue, tag.size()));
}

bool isParallelVtkXml(std::string_view start)
{
  const std::optional<std::string_view> type = typeOfXml(start);
  return type && (type->starts_with("PPolyData") || type->starts_with("PUnstructuredGrid"));
}

bool isVtkXml(std::string_view start)
{
  return typeOfXml(start) && !isParallelVtkXml(start);
}

constexpr FileSuffix LegacySuffixes[] = { { ".vtk", true, true, FileForm::Either } };
constexpr FileSuffix XmlSuffixes[] = { { ".vtp", true, false }, { ".vtu" } };
constexpr FileSuffix ParallelSuffixes[] = { { ".pvtp", true, false }, { ".pvtu" } };

void importLegacyVtk(InputFile& file, RawMeshBuilder& builder)
{
  readVtkMesh(file, legacyVtkLayout(file), builder);
}

void importVtkXml(InputFile& file, RawMeshBuilder& builder)
{
  VtkLayout layout;
  addVtkXmlLayout(file, layout, builder.workspace().available() / 2);
  readVtkMesh(file, layout, builder);
}

/** The names of the pieces are held in memory. */
constexpr std::size_t MaxPieces = 100000;

/** The files that a .pvtp or .pvtu file names, or the same compressed. Throws Error if it is none.
 */
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
      if (files.size() == MaxPieces)
      {
        file.fail(tag.begin,
          "there are more than " + std::to_string(MaxPieces) + " pieces, which are too many");
      }
      if (nearbyFile(folder, source).empty())
      {
        file.fail(tag.begin, "the piece " + inQuotes(source) +
                               " is not in the folder of the file or below: only such "
                               "files are read");
      }
      const std::filesystem::path found = plainOrCompressed(folder / source);
      files.push_back(found.empty() ? folder / source : found);
    }
  }
  if (files.empty())
  {
    file.fail(root.begin, "the file names no pieces");
  }
  return files;
}

std::vector<std::filesystem::path> namedPieces(const std::filesystem::path& path)
{
  try
  {
    InputFile file(path);
    if (!isCompressed(file))
    {
      return pieceFiles(file);
    }
    Workspace space({}, Workspace::MinMemory);
    const InflatedFile inflated(file, space, "index");
    InputFile index(inflated.path(), {}, path.string());
    return pieceFiles(index);
  }
  catch (const Error&)
  {
    return {};
  }
}

void parseParallel(InputFile& file, RawMeshBuilder& builder, const MeshPart& /*part*/,
  const ProgressFunction& progress)
{
  const std::int64_t maxBytes = builder.workspace().available() / 2;
  VtkLayout layout;
  std::deque<InflatedFile> inflated;
  for (const std::filesystem::path& path : pieceFiles(file))
  {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
    {
      throw Error(file.name() + ": the piece " + inQuotes(path.string()) +
                  " that the file names does not exist.");
    }
    InputFile piece(path);
    if (!isCompressed(piece))
    {
      addVtkXmlLayout(piece, layout, maxBytes);
      continue;
    }
    const std::string name = "piece" + std::to_string(inflated.size());
    inflated.emplace_back(piece, builder.workspace(), name.c_str());
    InputFile content(inflated.back().path(), {}, path.string());
    addVtkXmlLayout(content, layout, maxBytes);
  }
  readVtkMesh(file, layout, builder, progress);
}

} // namespace

const Format LegacyVtkFormat{
  .name = "legacy VTK",
  .suffixes = LegacySuffixes,
  .description = "versions 2.0 to 5.1, text and binary; written as 3.0",
  .cells = "polygonal data, unstructured grids",
  .holdsColumns = true,
  .groups = GroupForm::Columns,
  .isReadByVtk = true,
  .hasMagic = isLegacyVtk,
  .alwaysHasMagic = true,
  .parse = parseWith<importLegacyVtk>,
  .typicalBytes = { 45, 3 },
  .bytes = bytesOfVtk,
  .writer = makeLegacyVtkWriter,
  .scratch = scratchOfTextVtk,
};

const Format VtkXmlFormat{
  .name = "VTK XML",
  .suffixes = XmlSuffixes,
  .description = "text, base64, raw; plain or compressed by zlib, LZ4 or LZMA",
  .cells = "polygonal data (the only cells of `.vtp`), unstructured grids",
  .holdsColumns = true,
  .groups = GroupForm::Columns,
  .isReadByVtk = true,
  .hasMagic = isVtkXml,
  .firstCharacter = '<',
  .parse = parseWith<importVtkXml>,
  .bytes = bytesOfVtkXml,
  .writer = makeVtkXmlWriter,
  .writeOrder = WriteOrder::Interleaved,
};

const Format ParallelVtkXmlFormat{
  .name = "VTK XML in pieces",
  .suffixes = ParallelSuffixes,
  .description = "pieces in the folder of the file or below, each compressed or not; written by "
                 "`vtkStreamingMeshWriter`",
  .cells = "as VTK XML",
  .holdsColumns = true,
  .groups = GroupForm::Columns,
  .isReadByVtk = true,
  .hasMagic = isParallelVtkXml,
  .firstCharacter = '<',
  .parse = parseParallel,
  .furtherInputs = namedPieces,
};

} // namespace smg
