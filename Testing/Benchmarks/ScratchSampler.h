// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <thread>

namespace smg::benchmark
{

/**
 * Watches how much of the disk this process's open files in a folder take, also those that have no
 * name any more, every few milliseconds on a thread of its own.
 */
class ScratchSampler
{
public:
  explicit ScratchSampler(const std::filesystem::path& folder);

  struct Result
  {
    std::int64_t largest = 0; ///< most bytes on disk at once
    double cpuSeconds = 0;    ///< of the watching itself
  };
  /** Ends the watching. */
  Result finish();

private:
  void watch(const std::stop_token& stop);

  std::filesystem::path Folder;
  Result Seen;
  std::jthread Thread; ///< the last member: it uses the others
};

} // namespace smg::benchmark
