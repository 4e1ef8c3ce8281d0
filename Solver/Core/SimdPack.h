// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace smg
{

/** A vector of `Count` values of Real: the right-hand sides of a node, which are contiguous in
 * memory. */
template <class Real, int Count>
struct SimdPack
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

/**
 * Calls f with the number of columns, as a compile-time constant if it is small, to unroll loops.
 */
template <class F>
void withColumns(int columns, F&& f)
{
  switch (columns)
  {
    case 1:
      return f(std::integral_constant<int, 1>());
    case 2:
      return f(std::integral_constant<int, 2>());
    case 3:
      return f(std::integral_constant<int, 3>());
    case 4:
      return f(std::integral_constant<int, 4>());
    default:
      return f(columns);
  }
}

/**
 * Copies `columns` values per node to nodes of strideOf(columns) values; the padding becomes zero.
 */
template <class Real>
void pad(const Real* packed, int columns, std::int64_t nodes, Real* padded)
{
  withColumns(columns,
    [=](auto count) mutable
    {
      const int stride = strideOf(count);
      for (std::int64_t i = 0; i < nodes; ++i, packed += count, padded += stride)
      {
        std::memcpy(padded, packed, count * sizeof(Real));
        std::fill(padded + count, padded + stride, Real{});
      }
    });
}

/** The inverse, from nodes of `stride` values, at least `columns`. */
template <class Real>
void unpad(const Real* padded, int stride, int columns, std::int64_t nodes, Real* packed)
{
  withColumns(columns,
    [=](auto count) mutable
    {
      for (std::int64_t i = 0; i < nodes; ++i, packed += count, padded += stride)
      {
        std::memcpy(packed, padded, count * sizeof(Real));
      }
    });
}

} // namespace smg
