// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "IO/Files/Decompressor.h"
#include "IO/Files/InputFile.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace smg
{

/** Whether this file is compressed as a whole: by gzip, xz or zstd. */
inline bool isCompressed(InputFile& file)
{
  return compressionOf(file.at(0, MemberStartBytes)) != Compression::None;
}

/**
 * Decompresses a file of one or several members to the file `to` and verifies checksums.
 * Throws Error, which names the file and the byte, if it is damaged, truncated or not compressed.
 */
void inflateFile(InputFile& file, Workspace& workspace, const std::filesystem::path& to);

/** The decompressed content of a compressed file as a file that is removed at the end of the scope.
 */
class InflatedFile
{
public:
  /** Creates the file of this name in the folder of the workspace. Throws like inflateFile(). */
  InflatedFile(InputFile& file, Workspace& workspace, const char* name);
  ~InflatedFile();
  InflatedFile(const InflatedFile&) = delete;
  InflatedFile& operator=(const InflatedFile&) = delete;

  const std::filesystem::path& path() const { return this->Path; }

private:
  std::filesystem::path Path;
};

/** The first bytes of the content of such a file, at most `most`, decompressed from its first
 * bytes. */
std::string inflateStart(std::string_view bytes, std::size_t most);

} // namespace smg
