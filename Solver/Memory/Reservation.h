// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Pool.h"

#include <algorithm>
#include <cstdint>

namespace smg
{

/** What is made of a block of the stream is not accounted for up to so many bytes, a constant that
 * blocks of usual streams do not reach; more of it is, where very many vertices become final at
 * once. */
inline constexpr std::int64_t UnaccountedBytes = std::int64_t(4) << 20;

constexpr std::int64_t accountedBytes(std::int64_t bytes)
{
  return std::max<std::int64_t>(0, bytes - UnaccountedBytes);
}

/** Memory that another class uses, accounted for in a pool. */
class Reservation
{
public:
  explicit Reservation(Pool& pool, std::int64_t bytes = 0)
    : Owner(pool)
    , Bytes(bytes)
  {
    pool.acquire(bytes);
  }
  ~Reservation() { this->Owner.release(this->Bytes); }
  Reservation(const Reservation&) = delete;
  Reservation& operator=(const Reservation&) = delete;

  std::int64_t bytes() const { return this->Bytes; }
  /** Accounts for so many bytes instead. Above the limit, throws Error and changes nothing. */
  void resize(std::int64_t bytes)
  {
    if (bytes > this->Bytes)
    {
      this->Owner.acquire(bytes - this->Bytes);
    }
    else if (bytes < this->Bytes)
    {
      this->Owner.release(this->Bytes - bytes);
    }
    this->Bytes = bytes;
  }

private:
  Pool& Owner;
  std::int64_t Bytes;
};

} // namespace smg
