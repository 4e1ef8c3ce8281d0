// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

namespace smg::benchmark
{

/** Bytes per second that `threads` threads move between memory and the processor: STREAM's triad a
 * = b + s c on arrays of `bytes` bytes each, far beyond the caches; the best of several runs. */
double memoryBandwidth(int threads, std::int64_t bytes);

/** Bytes per second of sequential writes and reads of a file. */
struct FileBandwidth
{
  double cachedWrite = 0; ///< to the system's page cache
  double cachedRead = 0;  ///< from there
  double diskWrite = 0;   ///< until it is on the disk
  double diskRead = 0;    ///< after dropping it from the page cache
};

/** Measures with a scratch file of `bytes` bytes in `folder`. A virtual disk may have a cache of
 * its own, which the figures of the disk then include. */
FileBandwidth fileBandwidth(const std::filesystem::path& folder, std::int64_t bytes);

} // namespace smg::benchmark
