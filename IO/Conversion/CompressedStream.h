// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Convert.h"

#include <filesystem>

namespace smg
{

/** Whether the file is compressed by gzip and, as far as its beginning tells, no mesh to parse. */
bool isCompressedStream(const std::filesystem::path& path);

/**
 * Converts such a file by way of one that is not compressed, in the scratch folder. Throws as
 * convert(), and Error if the compressed data are damaged.
 */
ConversionReport convertCompressedStream(const std::filesystem::path& in,
  const std::filesystem::path& out, const ConversionOptions& options);

} // namespace smg
