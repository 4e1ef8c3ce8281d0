// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"
#include "IO/External/Workspace.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace smg
{

/**
 * Sorts rows of bytes by a number, the key, in a given memory: put() all, then sort(), then next()
 * delivers them. Rows with the same key stay in the sequence in which they were put.
 *
 * The rows of a sort have all one size, which is known at run time only: that is the difference to
 * ExternalSort. Runs that fill the memory go to scratch files. There are never many of these: as
 * soon as the merge of a level is due, it is done.
 */
class RowSort
{
public:
  struct Row
  {
    std::uint64_t key = 0;
    const std::byte* bytes = nullptr;
  };

  /** Uses about `memory` bytes, 1 MiB at least, of the workspace's pool. */
  RowSort(Workspace& workspace, std::int64_t memory, std::size_t rowBytes);
  ~RowSort();
  RowSort(const RowSort&) = delete;
  RowSort& operator=(const RowSort&) = delete;

  std::int64_t size() const { return this->Size; }

  /** Where the bytes of the next row go, until the next call. Throws Error. */
  std::byte* put(std::uint64_t key)
  {
    if (this->Used == this->Capacity)
    {
      this->makeRoom();
    }
    this->keys()[this->Used] = { key, static_cast<std::uint32_t>(this->Used) };
    ++this->Size;
    return this->Rows.data() + this->Used++ * this->RowBytes;
  }

  /** Ends the putting. Afterwards no more than a quarter of the memory is in use until next(). */
  void sort();

  /** The next row in order, valid until the next call; false at the end. */
  bool next(Row& row);

private:
  struct Key
  {
    std::uint64_t key;
    std::uint32_t place; ///< in the run
  };
  /** Rows in order, each after its key; made of about mostRuns() ^ level runs of the memory. */
  struct Run
  {
    BucketFile rows;
    int level;
  };
  class Merge;

  Key* keys() { return reinterpret_cast<Key*>(this->Keys.data()); }
  std::size_t mostRuns() const;
  void makeRoom();
  void allocate(std::size_t rows);
  void sortKeys();
  void writeRun();
  void mergeLast(std::size_t count);

  Workspace& Space;
  std::size_t Memory, RowBytes;
  std::int64_t Size = 0;
  Buffer Keys, Rows; ///< what is collected
  std::size_t Capacity = 0, Used = 0, Delivered = 0;
  std::vector<Run> Runs; ///< levels never ascend; rows of earlier runs were put earlier
  std::unique_ptr<Merge> Merged;
};

} // namespace smg
