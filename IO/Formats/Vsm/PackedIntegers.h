// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Packs integers with as few bytes each as the largest one needs: a byte with this number, then
 * all lowest bytes, all second bytes and so on, which compresses best. */
void packIntegers(std::span<const std::uint64_t> values, std::vector<std::byte>& packed);

/** Reverses packIntegers; false if `packed` does not hold that many integers. */
bool unpackIntegers(std::span<const std::byte> packed, std::span<std::uint64_t> values);

/** The most bytes that so many integers are packed into. */
constexpr std::size_t maxPackedBytes(std::size_t values)
{
  return 1 + sizeof(std::uint64_t) * values;
}

/** Maps signed to unsigned integers so that small ones of either sign become small ones. */
constexpr std::uint64_t zigzag(std::int64_t value)
{
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}

constexpr std::int64_t unzigzag(std::uint64_t value)
{
  return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

} // namespace smg
