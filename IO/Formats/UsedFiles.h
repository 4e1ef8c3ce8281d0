// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

/**
 * The files that a program reads and those that it writes. A file that is written must be none of
 * the others, also by another name or through a link. A mesh may have further files than the one
 * that is named: both of TetGen, the pieces of VTK.
 */
class SMG_EXPORT UsedFiles
{
public:
  /** A file that is read. `what` describes it in an error, for example "the problem". */
  void read(const std::filesystem::path& path, const std::string& what);
  /** The mesh that is read, with its further files. */
  void readMesh(const std::filesystem::path& path, const std::string& what = "the mesh itself");
  /** A file that is written; `what` is a noun such as "report". */
  void write(const std::filesystem::path& path, const std::string& what);
  /** A mesh that is written, with its further files. */
  void writeMesh(const std::filesystem::path& path, const std::string& what = "result");

  /** Throws Error if a file that is written is another one of these. */
  void check() const;

private:
  struct Used
  {
    std::filesystem::path path;
    std::string what;
    std::filesystem::path of; ///< the mesh that it is a further file of; else empty
  };
  static void add(const std::filesystem::path& path, const std::string& what,
    std::vector<std::filesystem::path> further, std::vector<Used>& files);

  std::vector<Used> Read, Written;
};

/** The files of a mesh that is read; `path` is the first. */
SMG_EXPORT std::vector<std::filesystem::path> filesOfMesh(const std::filesystem::path& path);

/** The files of a mesh that is read, as they are when this object is made. What is computed in
 * several passes over them belongs to one mesh only if they remain what they are. */
class SMG_EXPORT InputState
{
public:
  /** Of no files. */
  InputState() = default;
  /** Files that do not exist are none. */
  explicit InputState(const std::filesystem::path& mesh);

  /** Throws Error that names the file if one has been replaced or changed since. */
  void check() const;
  /** Whether none has. No file is read for that. */
  bool isUnchanged() const
  {
    return std::ranges::all_of(
      this->Files, [](const File& file) { return File(file.path) == file; });
  }

private:
  struct File
  {
    std::filesystem::path path;
    std::uint64_t device = 0, inode = 0;
    std::int64_t size = -1;                    ///< -1: the file does not exist
    std::int64_t seconds = 0, nanoseconds = 0; ///< of the last change

    explicit File(std::filesystem::path name);
    bool operator==(const File&) const = default;
  };
  std::vector<File> Files;
};

} // namespace smg
