// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/Pool.h"

#include <cstdint>

namespace smg
{

/** Memory that another class uses, accounted for in a pool. */
class Reservation
{
public:
  Reservation(Pool& pool, std::int64_t bytes)
    : Owner(pool)
    , Bytes(bytes)
  {
    pool.acquire(bytes);
  }
  ~Reservation() { this->Owner.release(this->Bytes); }
  Reservation(const Reservation&) = delete;
  Reservation& operator=(const Reservation&) = delete;

private:
  Pool& Owner;
  std::int64_t Bytes;
};

} // namespace smg
