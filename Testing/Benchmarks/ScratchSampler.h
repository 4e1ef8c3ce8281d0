// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <thread>

namespace smg::benchmark
{

/** Samples the disk space of this process's open files in a folder, including unlinked ones, every
 * few milliseconds on a separate thread. */
class ScratchSampler
{
public:
  explicit ScratchSampler(const std::filesystem::path& folder);

  struct Result
  {
    std::int64_t largest = 0; ///< most bytes on disk at once
    double cpuSeconds = 0;    ///< of the sampling itself
  };
  /** Ends the sampling. */
  Result finish();

private:
  void watch(const std::stop_token& stop);

  std::filesystem::path Folder;
  Result Seen;
  std::jthread Thread; ///< the last member, since it uses the others
};

} // namespace smg::benchmark
