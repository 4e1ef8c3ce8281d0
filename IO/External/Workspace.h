// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Storage/BlockFile.h"
#include "Solver/Storage/Pool.h"
#include "Solver/Storage/ScratchFolder.h"

#include <cstdint>
#include <filesystem>

namespace smg
{

/** Where an out-of-core operation works: an accounted pool of memory and a folder for files. */
class Workspace
{
public:
  /** Least memory that out-of-core operations are made for, in bytes. */
  static constexpr std::int64_t LeastMemory = std::int64_t(16) << 20;

  /**
   * At most `memory` bytes are used, at least LeastMemory. Files go to a folder of its own in
   * `scratch`; empty: the system's temporary folder.
   */
  Workspace(const std::filesystem::path& scratch, std::int64_t memory,
    const ProgressFunction& progress = {});

  Pool& pool() { return this->Memory; }
  /** Bytes of memory that are not in use. */
  std::int64_t available() const { return this->Memory.limit() - this->Memory.used(); }
  const std::filesystem::path& folder() const { return this->Folder.path(); }
  IoStatistics& traffic() { return this->Traffic; }

  /** Tells how much of the whole operation is done, 0 to 1. Throws Cancelled. */
  void progress(double done) { this->Reported.update(done); }

private:
  ScratchFolder Folder;
  Pool Memory;
  IoStatistics Traffic;
  Progress Reported;
};

} // namespace smg
