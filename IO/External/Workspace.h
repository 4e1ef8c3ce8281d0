// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Storage/BlockFile.h"
#include "Solver/Storage/Pool.h"
#include "Solver/Storage/ScratchFolder.h"
#include "smg/Export.h"

#include <cstdint>
#include <filesystem>

namespace smg
{

/** Where an out-of-core operation works: an accounted pool of memory and a folder for files. */
class SMG_EXPORT Workspace
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

  /**
   * Begins the part of the whole operation that ends when the fraction `end` of it is done, and
   * that has about `bytes` of traffic, by which poll() tells how far it is.
   */
  void beginPart(double end, std::int64_t bytes);
  /** The fraction that is done when the current part ends. */
  double partEnd() const { return this->PartEnd; }
  /** Tells that the fraction `done` of the part is done. Throws Cancelled. */
  void tell(double done);
  /** Tells progress, now and then while there is traffic. Throws Cancelled. */
  void poll();

private:
  std::int64_t trafficBytes() const { return this->Traffic.bytesRead + this->Traffic.bytesWritten; }

  ScratchFolder Folder;
  Pool Memory;
  IoStatistics Traffic;
  Progress Reported;
  double PartBegin = 0, PartEnd = 0;
  std::int64_t PartTraffic = 0; ///< when the part began
  std::int64_t PartBytes = 1;
};

} // namespace smg
