// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "IO/Files/InputFile.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace smg
{

/** Whether a file that begins with these bytes is compressed by gzip. */
inline bool isGzip(std::string_view bytes)
{
  return bytes.starts_with("\x1f\x8b");
}

/**
 * Writes what a file holds that gzip compressed, one member or several, to the file `to`. Checksums
 * are checked. Throws Error naming the file and the byte: it is damaged, truncated or not of gzip.
 */
void inflateFile(InputFile& file, Workspace& workspace, const std::filesystem::path& to);

/** What a file holds that gzip compressed, as a file that is removed at the end of the scope. */
class InflatedFile
{
public:
  /** Makes the file of this name in the workspace's folder. Throws as inflateFile(). */
  InflatedFile(InputFile& file, Workspace& workspace, const char* name);
  ~InflatedFile();
  InflatedFile(const InflatedFile&) = delete;
  InflatedFile& operator=(const InflatedFile&) = delete;

  const std::filesystem::path& path() const { return this->Path; }

private:
  std::filesystem::path Path;
};

/** The first bytes of what such a file holds, at most `most`, as far as its first bytes tell. */
std::string inflateStart(std::string_view bytes, std::size_t most);

} // namespace smg
