// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/MeshFile.h"

#include "IO/Formats/StreamConversion.h"
#include "IO/Formats/StreamFile.h"
#include "IO/Formats/Suffix.h"
#include "IO/Import/Importer.h"
#include "IO/Output/WritePly.h"
#include "IO/Output/WriteVtkXml.h"
#include "Solver/Core/Error.h"
#include "Solver/Storage/BlockFile.h"
#include "Solver/Storage/FileDescriptor.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include <unistd.h>

namespace smg
{

namespace
{

/** Whether the content of a file is that of a streaming format, whatever its name. */
bool looksLikeStream(const std::filesystem::path& path)
{
  try
  {
    detectStreamFormat(path);
    return true;
  }
  catch (const Error&)
  {
    return false;
  }
}

} // namespace

MeshFileKind kindOfInput(const std::filesystem::path& path)
{
  const std::string suffix = lowerSuffix(path);
  std::error_code ignored;
  const bool isFile = std::filesystem::is_regular_file(path, ignored);
  if (suffix == ".vsm" || (isFile && isBlockFile(path)))
  {
    return MeshFileKind::Vsm;
  }
  if (isFile && meshFormatOfContent(path) != MeshFormat::Unknown)
  {
    return MeshFileKind::Indexed;
  }
  constexpr std::string_view streams[] = { ".sma", ".smb", ".smc", ".smd", ".sva", ".svb", ".svc" };
  // A binary STL file begins with anything, and an OBJ file may look like a streaming one.
  const bool saysNothing = suffix == ".stl" || suffix == ".obj";
  if (std::find(std::begin(streams), std::end(streams), suffix) != std::end(streams) ||
      (isFile && !saysNothing && looksLikeStream(path)))
  {
    return MeshFileKind::Stream;
  }
  return meshFormat(path) == MeshFormat::Unknown ? MeshFileKind::Unknown : MeshFileKind::Indexed;
}

MeshFileKind kindOfOutput(const std::filesystem::path& path)
{
  const std::string suffix = lowerSuffix(path);
  if (suffix == ".vsm")
  {
    return MeshFileKind::Vsm;
  }
  if (suffix == ".vtp" || suffix == ".vtu")
  {
    return MeshFileKind::VtkXml;
  }
  if (suffix == ".ply")
  {
    return MeshFileKind::Ply;
  }
  return streamFormatOfName(path) ? MeshFileKind::Stream : MeshFileKind::Unknown;
}

void checkOutput(const std::filesystem::path& path)
{
  if (kindOfOutput(path) == MeshFileKind::Unknown)
  {
    throw Error(path.string() + ": meshes are written as .vsm, .sma, .smb, .sva, .svb, .ply, .vtp "
                                "or .vtu: choose a name that ends so. Other formats come of a "
                                ".vsm file by smg convert --restore-order.");
  }
  checkOutputPlace(path);
}

void checkOutput(const std::filesystem::path& path, CellType cellType)
{
  checkOutput(path);
  switch (kindOfOutput(path))
  {
    case MeshFileKind::VtkXml:
      checkVtkXmlPath(path, cellType);
      break;
    case MeshFileKind::Ply:
      checkPlyPath(path, cellType);
      break;
    case MeshFileKind::Stream:
      checkStreamPath(path, cellType);
      break;
    default:
      break;
  }
}

void checkOutputPlace(const std::filesystem::path& path)
{
  // A folder that cannot be searched is reported below.
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
  {
    throw Error(path.string() + ": this is a folder: choose the name of a file.");
  }
  const std::filesystem::path target = FileDescriptor::targetOf(path);
  if (std::filesystem::exists(target, ignored) &&
      !std::filesystem::is_regular_file(target, ignored))
  {
    throw Error(path.string() + ": this is a device or a pipe: choose the name of a file.");
  }
  const std::filesystem::path parent = target.parent_path();
  const std::filesystem::path folder = parent.empty() ? std::filesystem::path(".") : parent;
  if (!std::filesystem::is_directory(folder, ignored))
  {
    throw Error(path.string() + ": there is no folder " + folder.string() + '.');
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
  {
    throw Error(path.string() + ": no file can be made in the folder " + folder.string() + ": " +
                std::strerror(errno) + '.');
  }
}

void checkIsNotInput(
  const std::filesystem::path& in, const std::filesystem::path& out, const std::string& what)
{
  std::error_code absent;
  if (std::filesystem::equivalent(in, out, absent))
  {
    throw Error(out.string() + " is " + what + ": choose another name for the result.");
  }
}

} // namespace smg
