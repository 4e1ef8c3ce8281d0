// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace smg
{

/** Numbers of 1 to 5 bytes, seven bits per byte, the lowest first: small differences are short. */
namespace varint
{

inline std::byte* put(std::byte* to, std::uint32_t value)
{
  for (; value >= 0x80; value >>= 7)
  {
    *to++ = static_cast<std::byte>(value | 0x80);
  }
  *to++ = static_cast<std::byte>(value);
  return to;
}

inline const std::byte* get(const std::byte* from, std::uint32_t& value)
{
  value = static_cast<std::uint32_t>(*from++);
  if (value >= 0x80)
  {
    value &= 0x7f;
    for (int shift = 7;; shift += 7)
    {
      const auto digit = static_cast<std::uint32_t>(*from++);
      value |= (digit & 0x7f) << shift;
      if (digit < 0x80)
      {
        break;
      }
    }
  }
  return from;
}

/**
 * A difference modulo 2^32 as a number that is small if the difference is small, for both signs.
 */
inline std::uint32_t zigzag(std::uint32_t difference)
{
  return (difference << 1) ^ (0u - (difference >> 31));
}
inline std::uint32_t unzigzag(std::uint32_t value)
{
  return (value >> 1) ^ (0u - (value & 1));
}

} // namespace varint

/**
 * A view of a page of vertices in memory, or of its adjacency part. The format: the offset of the
 * adjacency of each vertex (16 bits each, or 32 if necessary), a degree and the differences of the
 * neighbours' ranks to that of the vertex, as varints; then the positions, the numbers in the raw
 * mesh, and the coordinates. Each part begins at a multiple of 4.
 */
class PageView
{
public:
  /** Lists of more bytes than this have 32-bit offsets. */
  static constexpr std::uint32_t MostNarrowBytes = 65532;

  static constexpr std::uint32_t rounded(std::uint32_t bytes) { return (bytes + 3) / 4 * 4; }
  static constexpr std::uint32_t narrowOffsetBytes(std::uint32_t vertices)
  {
    return rounded(2 * vertices);
  }

  /** `adjacency`: bytes of the adjacency part, which determine the width of the offsets. */
  PageView(
    std::byte* bytes, std::uint32_t firstRank, std::uint32_t vertices, std::uint32_t adjacency)
    : Bytes(bytes)
    , FirstRank(firstRank)
    , Vertices(vertices)
    , Adjacency(adjacency)
    , Wide(adjacency > narrowOffsetBytes(vertices) + MostNarrowBytes)
  {
  }

  std::uint32_t firstRank() const { return this->FirstRank; }
  std::uint32_t vertices() const { return this->Vertices; }

  /** Calls visit(rank) for each neighbour of the page's vertex number `vertex`. */
  template <class Visit>
  void neighbours(std::uint32_t vertex, Visit&& visit) const
  {
    const std::uint32_t rank = this->FirstRank + vertex;
    std::uint32_t degree, difference;
    const std::byte* at = varint::get(this->list(vertex), degree);
    for (std::uint32_t i = 0; i < degree; ++i)
    {
      at = varint::get(at, difference);
      visit(rank + varint::unzigzag(difference));
    }
  }

  /** The rest is available only for whole pages. */
  std::span<std::uint32_t> places() const { return { this->numbers(0), this->Vertices }; }
  std::span<const std::uint32_t> ids() const { return { this->numbers(1), this->Vertices }; }
  /** The consecutive coordinates of a vertex: floats or doubles, unaligned. */
  const std::byte* position(std::uint32_t vertex, std::size_t positionBytes) const
  {
    return this->Bytes + this->Adjacency + std::size_t(8) * this->Vertices + vertex * positionBytes;
  }

private:
  const std::byte* list(std::uint32_t vertex) const
  {
    if (this->Wide)
    {
      std::uint32_t begin;
      std::memcpy(&begin, this->Bytes + std::size_t(4) * vertex, 4);
      return this->Bytes + std::size_t(4) * this->Vertices + begin;
    }
    std::uint16_t begin;
    std::memcpy(&begin, this->Bytes + std::size_t(2) * vertex, 2);
    return this->Bytes + narrowOffsetBytes(this->Vertices) + begin;
  }
  std::uint32_t* numbers(std::size_t which) const
  {
    return reinterpret_cast<std::uint32_t*>(this->Bytes + this->Adjacency) + which * this->Vertices;
  }

  std::byte* Bytes;
  std::uint32_t FirstRank, Vertices, Adjacency;
  bool Wide;
};

} // namespace smg
