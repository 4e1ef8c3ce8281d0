// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/Workspace.h"

#include <algorithm>

// The resources that out-of-core operations share, and their progress. Progress is measured by
// traffic of scratch files: a part says how much it expects, so that operations need not know how
// far they are.

namespace smg
{

namespace
{

constexpr PoolUse ConversionMemory{ "the conversion", "raise the memory limit (option --memory)" };

} // namespace

void checkLeastMemory(const std::string& operation, std::int64_t memory)
{
  if (memory < Workspace::MinMemory)
  {
    throw MemoryError(operation + " needs a memory limit of at least " +
                      std::to_string(Workspace::MinMemory >> 20) + " MiB, but it is " +
                      std::to_string(memory >> 20) + " MiB: raise it.");
  }
}

Workspace::Workspace(const std::filesystem::path& scratch, std::int64_t memory,
  const ProgressFunction& progress, std::int64_t scratchLimit, int threads)
  : Folder(scratch, scratchLimit)
  , Memory(std::max(memory, MinMemory), ConversionMemory)
  , Threads(threads)
  , Reported(progress)
{
}

std::int64_t Workspace::itemsAtOnce(std::int64_t bytes) const
{
  constexpr std::int64_t Most = 16;
  const std::int64_t threads = this->Threads.threads();
  // A sixteenth of the memory, since several such pipelines may be at work within one another.
  return threads == 1 || Workers::isCaller()
           ? 1
           : std::clamp<std::int64_t>(
               this->available() / 16 / bytes, 1, std::min(threads + 1, Most));
}

void Workspace::beginPart(double end, std::int64_t bytes)
{
  // A part begins where the one before has ended, whatever that has reported.
  this->PartBegin = this->PartEnd;
  this->PartEnd = end;
  this->PartTraffic = this->trafficBytes();
  this->PartBytes = std::max<std::int64_t>(bytes, 1);
  this->poll();
}

void Workspace::tell(double done)
{
  this->Reported.update(
    this->PartBegin + std::clamp(done, 0.0, 1.0) * (this->PartEnd - this->PartBegin));
}

void Workspace::poll()
{
  // Progress functions are called on the thread of the owner alone.
  if (Workers::isCaller())
  {
    return;
  }
  this->tell(static_cast<double>(this->trafficBytes() - this->PartTraffic) /
             static_cast<double>(this->PartBytes));
}

} // namespace smg
