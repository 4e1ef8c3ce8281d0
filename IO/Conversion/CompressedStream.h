// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Convert.h"

#include <filesystem>

namespace smg
{

/** Whether the file is a stream compressed by gzip, according to its first bytes and its name. */
bool isCompressedStream(const std::filesystem::path& path);

/** Converts such a file via an uncompressed file in the scratch folder. Throws like convert(), and
 * Error if the compressed data are damaged. */
ConversionReport convertCompressedStream(const std::filesystem::path& in,
  const std::filesystem::path& out, const ConversionOptions& options);

} // namespace smg
