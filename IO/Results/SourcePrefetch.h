// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Workers.h"
#include "smg/MeshSource.h"

#include <memory>
#include <utility>

namespace smg
{

/** A mesh stream whose next block is read while the current one is used, on a further thread, if it
 * may be read on any. */
class SourcePrefetch : public MeshSource
{
public:
  /** With 1 thread it does not read ahead. */
  SourcePrefetch(std::unique_ptr<MeshSource> source, int threads)
    : Source(std::move(source))
    , Threads(threads != 1 && this->Source->readsOnAnyThread() ? 2 : 1)
    , Reading(this->Threads, [this] { this->IsThere = this->Source->next(this->Following); })
  {
  }

  const StreamInfo& info() const override { return this->Source->info(); }

  bool next(MeshBlock& block) override
  {
    if (this->Threads.threads() == 1)
    {
      return this->Source->next(block);
    }
    if (!this->Reading.isPending())
    {
      this->Reading.submit();
    }
    this->Reading.finish();
    const bool isThere = this->IsThere; // the next reading sets it anew
    if (isThere)
    {
      std::swap(block, this->Following);
      this->Reading.submit();
    }
    return isThere;
  }

private:
  std::unique_ptr<MeshSource> Source;
  Workers Threads;
  MeshBlock Following;
  bool IsThere = false; ///< Following; else the stream has ended
  Workers::Job Reading;
};

} // namespace smg
