// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workers.h"
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
    , Reads(
        this->Threads, 1, [this](Read& read) { read.isThere = this->Source->next(read.block); },
        [this](Read& read) { std::swap(read, this->Taken); })
  {
  }

  const StreamInfo& info() const override { return this->Source->info(); }

  bool next(MeshBlock& block) override
  {
    if (this->Threads.threads() == 1)
    {
      return this->Source->next(block);
    }
    if (this->Reads.size() == 0)
    {
      this->read();
    }
    this->Reads.takeOldest();
    if (this->Taken.isThere)
    {
      std::swap(block, this->Taken.block);
      this->read();
    }
    return this->Taken.isThere;
  }

private:
  struct Read
  {
    MeshBlock block;
    bool isThere = false;
  };

  void read()
  {
    this->Reads.next();
    this->Reads.submit();
  }

  std::unique_ptr<MeshSource> Source;
  Workers Threads;
  Read Taken;
  OrderedJobs<Read> Reads;
};

} // namespace smg
