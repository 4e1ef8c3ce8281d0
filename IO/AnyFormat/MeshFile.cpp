// SPDX-License-Identifier: BSD-3-Clause
#include "IO/AnyFormat/MeshFile.h"

#include "IO/AnyFormat/FormatTable.h"
#include "IO/Files/Suffix.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "Solver/Storage/BlockFile.h"
#include "Solver/Storage/FileDescriptor.h"
#include "smg/Error.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <unistd.h>

namespace smg
{

namespace
{

/** Whether the content of a file is that of a streaming format, independent of its name. */
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
  if (isFile && formatOfContent(path))
  {
    return MeshFileKind::Indexed;
  }
  // A binary STL file may begin with any bytes, and an OBJ file may look like a streaming format.
  const Format* const named = formatOfName(path);
  const bool saysNothing = named && named->looksRight;
  if (isStreamSuffix(suffix) || (isFile && !saysNothing && looksLikeStream(path)))
  {
    return MeshFileKind::Stream;
  }
  return formatOfFile(path) ? MeshFileKind::Indexed : MeshFileKind::Unknown;
}

MeshFileKind kindOfOutput(const std::filesystem::path& path)
{
  return suffixFor(FormatUse::Write, path) ? formatOfName(path)->kind : MeshFileKind::Unknown;
}

void checkOutput(const std::filesystem::path& path)
{
  if (!suffixFor(FormatUse::Write, path))
  {
    throw Error(path.string() + ": meshes are written as " + suffixList(FormatUse::Write, "or") +
                ": choose such a suffix. Other formats are written from a .vsm file by smg convert "
                "--restore-order.");
  }
  checkOutputPlace(path);
}

void checkOutput(const std::filesystem::path& path, CellType cellType)
{
  checkOutput(path);
  const FileSuffix& suffix = *suffixFor(FormatUse::Write, path);
  if (!suffix.holds(cellType))
  {
    throw Error(path.string() + ": " + holdsNo(suffix, cellType, FormatUse::Write));
  }
}

void checkOutputPlace(const std::filesystem::path& path)
{
  // A folder that is not accessible is reported below.
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
