// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstring>

namespace smg
{

/** `Count` values of Real that are treated alike: right-hand sides next to each other in memory. */
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

/** Values a node for `columns` right-hand sides: 1, or as many groups of four as they need. */
constexpr int strideOf(int columns)
{
  return columns == 1 ? 1 : (columns + 3) / 4 * 4;
}

} // namespace smg
