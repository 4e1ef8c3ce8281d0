// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "Solver/Files/CheckedFile.h"
#include "Solver/Memory/Buffer.h"

#include <cstddef>
#include <cstdint>

namespace smg
{

/** A first-in first-out queue of any length in a fixed amount of memory: its front and its back are
 * in memory, the rest is in a scratch file. */
class SearchQueue
{
public:
  /** The workspace must outlive the queue. */
  SearchQueue(Workspace& workspace, std::size_t bytes);

  std::int64_t size() const { return this->Size; }

  /** Throws Error if the disk is full. */
  void push(std::uint32_t value)
  {
    if (this->BackEnd == this->Half)
    {
      this->spill();
    }
    reinterpret_cast<std::uint32_t*>(this->Back.data())[this->BackEnd++] = value;
    ++this->Size;
  }
  /** Of a non-empty queue. */
  std::uint32_t pop()
  {
    if (this->FrontBegin == this->FrontEnd)
    {
      this->refill();
    }
    --this->Size;
    return reinterpret_cast<const std::uint32_t*>(this->Front.data())[this->FrontBegin++];
  }

  void clear();

private:
  void spill();
  void refill();
  void turn();

  Workspace& Space;
  std::size_t Half; ///< values in a half of the memory
  Buffer Front, Back;
  std::size_t FrontBegin = 0, FrontEnd = 0, BackEnd = 0;
  std::int64_t Size = 0;
  CheckedFile File;
  std::int64_t FileBegin = 0; ///< of the values in the file that were not read
};

} // namespace smg
