// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstring>

namespace smg
{

/** A vector of `Count` values of Real: right-hand sides that are contiguous in memory. */
template <class Real, int Count>
struct Lanes
{
  static constexpr int count = Count;
  using Vector __attribute__((vector_size(sizeof(Real) * Count))) = Real;

  [[gnu::always_inline]] static inline Vector load(const Real* p)
  {
    Vector v;
    std::memcpy(&v, p, sizeof(v));
    return v;
  }
  [[gnu::always_inline]] static inline void store(Real* p, Vector v)
  {
    std::memcpy(p, &v, sizeof(v));
  }
};

/** Values per node for `columns` right-hand sides: 1, or a multiple of four. */
constexpr int strideOf(int columns)
{
  return columns == 1 ? 1 : (columns + 3) / 4 * 4;
}

} // namespace smg
