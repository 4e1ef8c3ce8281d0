// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

namespace smg::benchmark
{

/**
 * Bytes a second that `threads` threads move between memory and the processor: STREAM's triad
 * a = b + s c on arrays of `bytes` bytes each, far beyond the caches; the best of several runs.
 */
double memoryBandwidth(int threads, std::int64_t bytes);

/** Bytes a second of a file that is written and read from its first byte to its last. */
struct FileBandwidth
{
  double cachedWrite = 0; ///< to the system's page cache
  double cachedRead = 0;  ///< from there
  double diskWrite = 0;   ///< until the disk has it
  double diskRead = 0;    ///< after the system was asked to drop it from the page cache
};

/**
 * Measures with a scratch file of `bytes` bytes in `folder`. The disk's figures are as true as the
 * disk: a virtual one may have a cache of its own.
 */
FileBandwidth fileBandwidth(const std::filesystem::path& folder, std::int64_t bytes);

} // namespace smg::benchmark
