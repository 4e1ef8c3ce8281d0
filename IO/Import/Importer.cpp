// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/Importer.h"

#include "IO/Container/ReservedNames.h"
#include "IO/Formats/Suffix.h"
#include "IO/Import/Formats.h"
#include "Solver/Core/Error.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

namespace
{

std::atomic<VtkImporter> TheVtkImporter{ nullptr };

std::string firstBytes(const std::filesystem::path& path)
{
  std::string bytes(256, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return bytes;
}

/** Whether the first line is OFF or one of its variants, as COFF or STN4OFF. */
bool isOff(std::string_view bytes)
{
  const std::size_t at = bytes.find("OFF");
  return at <= 5 && bytes.substr(0, at).find_first_not_of("STCN4n") == std::string_view::npos &&
         (at + 3 == bytes.size() || std::isspace(static_cast<unsigned char>(bytes[at + 3])));
}

MeshFormat formatOfSuffix(const std::filesystem::path& path)
{
  const std::string suffix = lowerSuffix(path);
  constexpr std::pair<std::string_view, MeshFormat> suffixes[] = { { ".ply", MeshFormat::Ply },
    { ".obj", MeshFormat::Obj }, { ".off", MeshFormat::Off }, { ".stl", MeshFormat::Stl },
    { ".mesh", MeshFormat::Medit }, { ".msh", MeshFormat::Gmsh }, { ".vtk", MeshFormat::VtkLegacy },
    { ".vtp", MeshFormat::VtkXml }, { ".vtu", MeshFormat::VtkXml } };
  for (const auto& [name, format] : suffixes)
  {
    if (suffix == name)
    {
      return format;
    }
  }
  return MeshFormat::Unknown;
}

IndexedMesh importVtk(
  const std::filesystem::path& path, MeshFormat format, const ImportOptions& options)
{
  const VtkImporter importer = TheVtkImporter;
  if (!importer)
  {
    throw Error(
      path.string() +
      ": this is a VTK file, and this program was built without VTK: convert it to PLY or .mesh.");
  }
  return importer(path, format, options);
}

/** Takes out the columns whose names mean something else in a stream. */
void dropReserved(std::vector<Column>& columns, std::vector<std::string>& dropped)
{
  std::erase_if(columns,
    [&dropped](const Column& column)
    {
      const bool reserved = isReservedColumn(column.spec.name);
      if (reserved)
      {
        dropped.push_back(column.spec.name);
      }
      return reserved;
    });
}

} // namespace

void setVtkImporter(VtkImporter importer)
{
  TheVtkImporter = importer;
}

MeshFormat meshFormatOfContent(const std::filesystem::path& path)
{
  const std::string bytes = firstBytes(path);
  const auto begins = [&bytes](std::string_view text) { return bytes.starts_with(text); };
  if (begins("ply\n") || begins("ply\r"))
  {
    return MeshFormat::Ply;
  }
  if (begins("# vtk DataFile"))
  {
    return MeshFormat::VtkLegacy;
  }
  if (bytes.find("<VTKFile") != std::string::npos)
  {
    return MeshFormat::VtkXml;
  }
  if (begins("$MeshFormat"))
  {
    return MeshFormat::Gmsh;
  }
  if (bytes.find("MeshVersionFormatted") != std::string::npos)
  {
    return MeshFormat::Medit;
  }
  return isOff(bytes) ? MeshFormat::Off : MeshFormat::Unknown;
}

MeshFormat meshFormat(const std::filesystem::path& path)
{
  const MeshFormat format = meshFormatOfContent(path);
  return format != MeshFormat::Unknown ? format : formatOfSuffix(path);
}

IndexedMesh importMesh(const std::filesystem::path& path, const ImportOptions& options)
{
  InputFile file(path, options.progress);
  const MeshFormat format = meshFormat(path);
  const auto import = [&]
  {
    switch (format)
    {
      case MeshFormat::Ply:
        return importPly(file, options);
      case MeshFormat::Obj:
        return importObj(file, options);
      case MeshFormat::Off:
        return importOff(file, options);
      case MeshFormat::Stl:
        return importStl(file, options);
      case MeshFormat::Medit:
        return importMedit(file, options);
      case MeshFormat::Gmsh:
        return importGmsh(file, options);
      case MeshFormat::VtkLegacy:
      case MeshFormat::VtkXml:
        return importVtk(path, format, options);
      default:
        throw Error(
          path.string() +
          ": the format is not known by its content or suffix: meshes are read from .vsm, .sma, "
          ".smb, .sva, .svb, .ply, .obj, .off, .stl, .mesh, .msh, .vtk, .vtp and .vtu files.");
    }
  };
  IndexedMesh mesh = import();
  if (mesh.corners.empty())
  {
    throw Error(path.string() + ": the file has no triangles and no tetrahedra.");
  }
  dropReserved(mesh.vertexColumns, mesh.droppedColumns);
  dropReserved(mesh.cellColumns, mesh.droppedColumns);
  return mesh;
}

} // namespace smg
