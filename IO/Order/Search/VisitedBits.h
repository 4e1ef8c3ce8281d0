// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "IO/Order/Pages/GrowingArray.h"
#include "Solver/Memory/Buffer.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace smg
{

/** A bit for each of a number of ranks. Clearing is cheap if few are set. */
class VisitedBits
{
public:
  VisitedBits(Workspace& workspace, std::int64_t count)
    : Count(count)
    , Bits(workspace.pool(), bytesFor(count))
    , Changed(workspace)
  {
    this->Changed.reserve(MostRemembered);
    std::memset(this->Bits.data(), 0, this->Bits.size());
  }

  static std::size_t bytesFor(std::int64_t count) { return std::size_t(count + 63) / 64 * 8; }

  /** Sets a bit; returns whether it was not set before. */
  bool set(std::uint32_t rank)
  {
    std::uint64_t& word = this->words()[rank / 64];
    const std::uint64_t bit = std::uint64_t(1) << (rank % 64);
    if (word & bit)
    {
      return false;
    }
    if (word == 0)
    {
      this->remember(rank / 64);
    }
    word |= bit;
    return true;
  }

  bool isSet(std::uint32_t rank) const
  {
    return (this->words()[rank / 64] >> (rank % 64) & 1) != 0;
  }

  void clear()
  {
    if (this->Changed.size() == MostRemembered)
    {
      std::memset(this->Bits.data(), 0, this->Bits.size());
    }
    for (const std::uint32_t word : this->Changed.all())
    {
      this->words()[word] = 0;
    }
    this->Changed.clear();
  }

  /** The first rank from `rank` on whose bit is not set; the number of ranks if there is none. */
  std::int64_t firstUnset(std::int64_t rank) const
  {
    while (rank < this->Count)
    {
      const std::uint64_t unset = ~this->words()[rank / 64] >> (rank % 64);
      if (unset != 0)
      {
        return std::min(this->Count, rank + std::countr_zero(unset));
      }
      rank = (rank / 64 + 1) * 64;
    }
    return this->Count;
  }

private:
  static constexpr std::size_t MostRemembered = 16384;

  std::uint64_t* words() const { return reinterpret_cast<std::uint64_t*>(this->Bits.data()); }
  void remember(std::uint32_t word)
  {
    if (this->Changed.size() < MostRemembered)
    {
      this->Changed.push(word);
    }
  }

  std::int64_t Count;
  Buffer Bits;
  /** Words with bits set, up to a limit. */
  GrowingArray<std::uint32_t> Changed;
};

} // namespace smg
