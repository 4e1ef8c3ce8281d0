// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkFormats.h"

#include "IO/Files/InputFile.h"
#include "IO/Files/TextStart.h"
#include "IO/Formats/Vtk/LegacyVtkLayout.h"
#include "IO/Formats/Vtk/VtkMeshReader.h"
#include "IO/Formats/Vtk/VtkXmlLayout.h"
#include "IO/Formats/Vtk/WriteVtkXml.h"
#include "IO/Import/RawMeshBuilder.h"

#include <algorithm>

namespace smg
{

namespace
{

bool isLegacyVtk(std::string_view start)
{
  return textStart(start).starts_with("# vtk DataFile");
}

/** The type in the element VTKFile; empty if it is not such a file. */
std::optional<std::string_view> typeOfXml(std::string_view start)
{
  const std::string_view text = textStart(start);
  const std::size_t at = text.find("<VTKFile");
  if (!text.starts_with('<') || at == std::string_view::npos)
  {
    return {};
  }
  const std::string_view tag = text.substr(at, text.find('>', at) - at);
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

WriteNotes writeXml(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options)
{
  writeVtkXml(source, path, options.progress);
  return {};
}

void parseParallel(
  InputFile& file, RawMeshBuilder& builder, const MeshPart&, const ProgressFunction& progress)
{
  importParallelVtkXml(file, builder, progress);
}

constexpr FileSuffix LegacySuffixes[] = { { ".vtk" } };
constexpr FileSuffix XmlSuffixes[] = { { ".vtp", true, false }, { ".vtu" } };
constexpr FileSuffix ParallelSuffixes[] = { { ".pvtp", true, false }, { ".pvtu" } };

} // namespace

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

const Format LegacyVtkFormat{
  .name = "legacy VTK",
  .suffixes = LegacySuffixes,
  .attributes = AllColumns,
  .hasSign = isLegacyVtk,
  .parse = parseWith<importLegacyVtk>,
  .share = { 45, 3 },
  .bytes = bytesOfVtk,
  .restore = writeRestoredVtk,
};

const Format VtkXmlFormat{
  .name = "VTK XML",
  .suffixes = XmlSuffixes,
  .attributes = AllColumns,
  .hasSign = isVtkXml,
  .parse = parseWith<importVtkXml>,
  .bytes = bytesOfVtkXml,
  .write = writeXml,
  .restore = writeRestoredVtkXml,
};

const Format ParallelVtkXmlFormat{
  .name = "VTK XML in pieces",
  .suffixes = ParallelSuffixes,
  .attributes = AllColumns,
  .hasSign = isParallelVtkXml,
  .parse = parseParallel,
};

} // namespace smg
