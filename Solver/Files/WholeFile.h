// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include <filesystem>
#include <string_view>

namespace smg
{

/** Makes or replaces the file `path` with this content, atomically and durably; throws Error, and
 * then leaves an existing file as it is. */
SMG_EXPORT void writeFile(const std::filesystem::path& path, std::string_view text);

/** Renames a file or folder within a file system, replacing a file `to`; throws Error naming `to`.
 */
SMG_EXPORT void moveFile(const std::filesystem::path& from, const std::filesystem::path& to);

} // namespace smg
