// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/UsedFiles.h"

#include "IO/Formats/FormatTable.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Error.h"

#include <algorithm>
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
  // A file that does not exist can only be compared by name.
  std::error_code absent;
  const auto named = [](const std::filesystem::path& file)
  { return std::filesystem::absolute(FileDescriptor::targetOf(file)).lexically_normal(); };
  return std::filesystem::equivalent(a, b, absent) || named(a) == named(b);
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
  const auto require = [](const Used& written, const Used& other, const std::string& what)
  {
    if (!isSameFile(written.path, other.path))
    {
      return;
    }
    const std::string named = written.of.empty() ? "" : ' ' + written.of.string();
    const std::string part = other.of.empty() ? "" : "a file of " + other.of.string() + ", ";
    throw Error(other.path.string() + ": the " + written.what + named + " would overwrite it, " +
                part + "which is " + what + ": choose another name for the " + written.what + '.');
  };
  for (std::size_t k = 0; k < this->Written.size(); ++k)
  {
    const Used& written = this->Written[k];
    for (const Used& other : this->Read)
    {
      require(written, other, other.what);
    }
    for (std::size_t other = 0; other < k; ++other)
    {
      require(written, this->Written[other], "the " + this->Written[other].what);
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

bool InputState::isUnchanged() const
{
  return std::ranges::all_of(this->Files, [](const File& file) { return File(file.path) == file; });
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
