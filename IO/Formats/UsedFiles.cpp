// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/UsedFiles.h"

#include "IO/Files/FileNames.h"
#include "IO/Formats/FormatTable.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Error.h"

#include <sys/stat.h>
#include <system_error>
#include <utility>

namespace smg
{

namespace
{

using Paths = std::vector<std::filesystem::path>;

/** The files that a mesh to read has besides the one that is named. */
Paths furtherInputs(const std::filesystem::path& path)
{
  std::error_code absent;
  // To look into a pipe would take something out of it.
  const Format* const format =
    std::filesystem::is_regular_file(path, absent) ? formatOfFile(path) : nullptr;
  return format && format->furtherInputs ? format->furtherInputs(path) : Paths{};
}

Paths furtherOutputs(const std::filesystem::path& path)
{
  const Format* const format = formatOfName(path);
  return format && format->furtherOutputs ? format->furtherOutputs(path) : Paths{};
}

/** Whether both name the same file, which need not exist. */
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b)
{
  // A file that does not exist can only be compared by name, in a folder that may be a link.
  std::error_code absent;
  const auto named = [](const std::filesystem::path& file)
  {
    std::error_code unknown;
    const std::filesystem::path target = std::filesystem::absolute(FileDescriptor::targetOf(file));
    const std::filesystem::path folder =
      std::filesystem::weakly_canonical(target.parent_path(), unknown);
    return unknown ? target.lexically_normal() : folder / target.filename();
  };
  return std::filesystem::equivalent(a, b, absent) || named(a) == named(b);
}

/** Whether a file is a piece of a mesh in pieces that is written, NAME/NAME_0.vtu of NAME.pvtu: as
 * many as there are processes, which nobody knows before. */
bool isPieceOf(const std::filesystem::path& file, const std::filesystem::path& mesh)
{
  const std::string suffix = lowerSuffix(mesh);
  if (suffix != ".pvtu" && suffix != ".pvtp")
  {
    return false;
  }
  const std::string stem = mesh.stem().string(), name = file.filename().string();
  const std::string begin = stem + '_', end = '.' + suffix.substr(2);
  if (!name.starts_with(begin) || !name.ends_with(end))
  {
    return false;
  }
  const std::string number = name.substr(begin.size(), name.size() - begin.size() - end.size());
  return !number.empty() && number.find_first_not_of("0123456789") == std::string::npos &&
         isSameFile(file, mesh.parent_path() / stem / name);
}

} // namespace

void UsedFiles::add(const std::filesystem::path& path, const std::string& what, Paths further,
  std::vector<Used>& files)
{
  if (path.empty())
  {
    return;
  }
  files.push_back({ path, what, {} });
  for (std::filesystem::path& file : further)
  {
    files.push_back({ std::move(file), what, path });
  }
}

void UsedFiles::read(const std::filesystem::path& path, const std::string& what)
{
  add(path, what, {}, this->Read);
}

void UsedFiles::readMesh(const std::filesystem::path& path, const std::string& what)
{
  add(path, what, furtherInputs(path), this->Read);
}

void UsedFiles::write(const std::filesystem::path& path, const std::string& what)
{
  add(path, what, {}, this->Written);
}

void UsedFiles::writeMesh(const std::filesystem::path& path, const std::string& what)
{
  add(path, what, furtherOutputs(path), this->Written);
}

void UsedFiles::check() const
{
  const auto refuse =
    [](const Used& written, const Used& other, const std::string& what, const std::string& which)
  {
    const std::string named = written.of.empty() ? "" : ' ' + written.of.string();
    const std::string part = other.of.empty() ? "" : "a file of " + other.of.string() + ", ";
    throw Error(other.path.string() + ": the " + written.what + named + " would overwrite " +
                which + ", " + part + "which is " + what + ": choose another name for the " +
                written.what + '.');
  };
  for (std::size_t k = 0; k < this->Written.size(); ++k)
  {
    const Used& written = this->Written[k];
    for (const Used& other : this->Read)
    {
      if (isSameFile(written.path, other.path) || isPieceOf(other.path, written.path))
      {
        refuse(written, other, other.what, "it");
      }
    }
    for (std::size_t other = 0; other < k; ++other)
    {
      const Used& earlier = this->Written[other];
      const bool isSame = isSameFile(written.path, earlier.path);
      if (isSame || isPieceOf(written.path, earlier.path))
      {
        refuse(written, earlier, "the " + earlier.what, isSame ? "it" : "a piece of it");
      }
    }
  }
}

std::vector<std::filesystem::path> filesOfMesh(const std::filesystem::path& path)
{
  Paths files = furtherInputs(path);
  files.insert(files.begin(), path);
  return files;
}

InputState::File::File(std::filesystem::path name)
  : path(std::move(name))
{
  struct stat status = {};
  if (::stat(this->path.c_str(), &status) == 0)
  {
    this->device = status.st_dev;
    this->inode = status.st_ino;
    this->size = status.st_size;
    this->seconds = status.st_mtim.tv_sec;
    this->nanoseconds = status.st_mtim.tv_nsec;
  }
}

InputState::InputState(const std::filesystem::path& mesh)
{
  // The state comes before the look into the file, which may be another one then.
  this->Files.emplace_back(mesh);
  for (std::filesystem::path& file : furtherInputs(mesh))
  {
    this->Files.emplace_back(std::move(file));
  }
}

void InputState::check() const
{
  for (const File& file : this->Files)
  {
    if (!(File(file.path) == file))
    {
      throw Error(file.path.string() +
                  ": was replaced or changed while it was in use: run this again, and leave the "
                  "file as it is meanwhile.");
    }
  }
}

} // namespace smg
