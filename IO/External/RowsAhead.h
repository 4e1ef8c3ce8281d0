// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workers.h"
#include "IO/External/Workspace.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>

namespace smg
{

/** Rows of a sequence, which another thread produces while the owner takes those before them. */
template <class Row>
class RowsAhead
{
  static_assert(std::is_trivially_copyable_v<Row>);

public:
  /** Fills the span with the next rows; returns their number, fewer only at the end. It must not
   * submit jobs. */
  using Produce = std::function<std::size_t(std::span<Row>)>;

  static constexpr std::size_t MemoryBytes = std::size_t(128) << 10;
  static_assert(sizeof(Row) <= MemoryBytes / 2);

  /** Takes `memory` bytes, at least two rows, of the workspace, which must outlive it. */
  RowsAhead(Workspace& workspace, Produce produce, std::size_t memory = MemoryBytes)
    : Space(workspace)
    , Taken(workspace.pool(), memory / 2)
    , Produced(workspace.pool(), memory / 2)
    , Job([this, next = std::move(produce)] { this->ProducedRows = next(rows(this->Produced)); })
  {
    this->start();
  }
  ~RowsAhead()
  {
    if (this->IsProducing)
    {
      this->Space.workers().cancel(this->Job);
    }
  }
  RowsAhead(const RowsAhead&) = delete;
  RowsAhead& operator=(const RowsAhead&) = delete;

  /** The next row; returns false at the end. Rethrows an exception of the production; throws
   * Cancelled. */
  bool next(Row& row)
  {
    if (this->At == this->Count && !this->turn())
    {
      return false;
    }
    row = rows(this->Taken)[this->At++];
    return true;
  }
  /** The next rows, at most `most`, valid until the next call; none at the end. Throws the same. */
  std::span<const Row> some(std::size_t most)
  {
    if (this->At == this->Count && !this->turn())
    {
      return {};
    }
    const std::size_t count = std::min(most, this->Count - this->At);
    this->At += count;
    return rows(this->Taken).subspan(this->At - count, count);
  }

private:
  static std::span<Row> rows(Buffer& buffer)
  {
    return { reinterpret_cast<Row*>(buffer.data()), buffer.size() / sizeof(Row) };
  }

  void start()
  {
    this->Space.workers().submit(this->Job);
    this->IsProducing = true;
  }

  /** Takes what was produced; returns whether there is any. */
  bool turn()
  {
    if (!this->IsProducing)
    {
      return false;
    }
    this->IsProducing = false;
    this->Space.workers().finish(this->Job);
    this->Space.poll(); // which the production, on another thread, cannot
    std::swap(this->Taken, this->Produced);
    this->At = 0;
    this->Count = this->ProducedRows;
    if (this->Count == rows(this->Taken).size())
    {
      this->start();
    }
    return this->Count > 0;
  }

  Workspace& Space;
  Buffer Taken, Produced;
  std::size_t At = 0, Count = 0, ProducedRows = 0;
  Workers::Job Job;
  bool IsProducing = false;
};

} // namespace smg
