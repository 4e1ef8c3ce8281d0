// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/ScratchSampler.h"

#include <sys/stat.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <string>
#include <utility>

namespace smg::benchmark
{
namespace
{

/** Bytes on disk of the open files in the folder, each counted once. */
std::int64_t openBytes(const std::string& folder)
{
  std::int64_t bytes = 0;
  std::set<std::pair<dev_t, ino_t>> counted;
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry("/proc/self/fd", ignored), end; entry != end;
       entry.increment(ignored))
  {
    const std::string target = std::filesystem::read_symlink(entry->path(), ignored).string();
    struct stat status = {};
    // A file may be closed concurrently.
    if (target.starts_with(folder) && ::stat(entry->path().c_str(), &status) == 0 &&
        S_ISREG(status.st_mode) && counted.emplace(status.st_dev, status.st_ino).second)
    {
      bytes += 512 * static_cast<std::int64_t>(status.st_blocks);
    }
  }
  return bytes;
}

} // namespace

ScratchSampler::ScratchSampler(const std::filesystem::path& folder)
  : Folder(std::filesystem::canonical(folder) / "")
  , Thread([this](const std::stop_token& stop) { this->watch(stop); })
{
}

void ScratchSampler::watch(const std::stop_token& stop)
{
  while (!stop.stop_requested())
  {
    this->Seen.largest = std::max(this->Seen.largest, openBytes(this->Folder.string()));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  timespec time = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  this->Seen.cpuSeconds =
    static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

ScratchSampler::Result ScratchSampler::finish()
{
  this->Thread.request_stop();
  this->Thread.join();
  return this->Seen;
}

} // namespace smg::benchmark
