// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"
#include "Solver/Core/Progress.h"
#include "Solver/Core/Workers.h"
#include "Solver/Files/ScratchAccount.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Memory/Pool.h"
#include "smg/Export.h"

#include <cstdint>
#include <filesystem>

namespace smg
{

/** Throws MemoryError if an operation, as "a conversion", is given less than Workspace::MinMemory.
 */
SMG_EXPORT void checkLeastMemory(const std::string& operation, std::int64_t memory);

/**
 * The resources of an out-of-core operation: an accounted pool of memory, a folder for files, and
 * threads.
 */
class SMG_EXPORT Workspace
{
public:
  /** The minimum memory of out-of-core operations, in bytes. */
  static constexpr std::int64_t MinMemory = std::int64_t(16) << 20;

  /** At most `memory` bytes are used, at least MinMemory. Files are created in a new folder in
   * `scratch`; empty: the system's temporary folder. They have at most `scratchLimit` bytes at
   * once; 0: any number. `threads`: see Workers. */
  Workspace(const std::filesystem::path& scratch, std::int64_t memory,
    const ProgressFunction& progress = {}, std::int64_t scratchLimit = 0, int threads = 0);

  Pool& pool() { return this->Memory; }
  /** The unused memory in bytes. */
  std::int64_t available() const { return this->Memory.limit() - this->Memory.used(); }
  const std::filesystem::path& folder() const { return this->Folder.path(); }
  /** The most bytes of scratch files at once. */
  std::int64_t peakScratch() const { return this->Folder.account().peak(); }
  IoStatistics& traffic() { return this->Traffic; }
  Workers& workers() { return this->Threads; }
  /** The number of items of `bytes` bytes, at least 1, on which all threads work at once in a
   * sixteenth of the memory that is left: see OrderedJobs. 1 in a job on another thread. */
  std::int64_t itemsAtOnce(std::int64_t bytes) const;

  /** Begins the part of the operation that ends when the fraction `end` of the whole is done. Its
   * traffic is about `bytes`, by which poll() computes the progress. */
  void beginPart(double end, std::int64_t bytes);
  /** The fraction that is done at the end of the current part. */
  double partEnd() const { return this->PartEnd; }
  /** Reports that the fraction `done` of the part is done. Throws Cancelled. */
  void tell(double done);
  /** Reports progress occasionally, by the traffic. Throws Cancelled. In a job on another thread
   * it does nothing: progress is reported by the thread of the owner. */
  void poll();

private:
  std::int64_t trafficBytes() const { return this->Traffic.bytesRead + this->Traffic.bytesWritten; }

  ScratchFolder Folder;
  Pool Memory;
  IoStatistics Traffic;
  Workers Threads;
  Progress Reported;
  double PartBegin = 0, PartEnd = 0;
  std::int64_t PartTraffic = 0; ///< at the beginning of the part
  std::int64_t PartBytes = 1;
};

} // namespace smg
