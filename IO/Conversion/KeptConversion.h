// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Convert.h"
#include "smg/Export.h"

#include <filesystem>
#include <optional>
#include <string>

namespace smg
{

/** Identifies a conversion of the current file: its name, size and time, and the options. */
std::string originOf(const std::filesystem::path& in, const ConversionOptions& options);

/** Whether `out` is what convertToKeep() makes, up to date, so that it does not convert. */
SMG_EXPORT bool isKept(const std::filesystem::path& in, const std::filesystem::path& out,
  const ConversionOptions& options);

/**
 * Converts a mesh file to a .vsm file that is kept and reused. The file is created if it does not
 * exist, and replaced if this function created it from an earlier version of the same file or with
 * other options. The .vsm file stores its origin (VsmFormat: origin).
 *
 * Any other existing file, including the conversion of another file, is not modified unless
 * `overwrite` is set. Concurrent processes with the same conversion wait for the first one and use
 * its file.
 *
 * @return the report of the conversion; none if `out` was up to date
 * @throws Error like convert(), and if `out` does not end in .vsm, is the input, or would be
 * overwritten without permission, or if another process has replaced it meanwhile; Cancelled. An
 * existing file is kept then.
 */
SMG_EXPORT std::optional<ConversionReport> convertToKeep(const std::filesystem::path& in,
  const std::filesystem::path& out, const ConversionOptions& options, bool overwrite = false);

} // namespace smg
