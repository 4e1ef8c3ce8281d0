// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace smg
{

/**
 * Compresses and decompresses the columns of blocks. Before compression the bytes of the tuples are
 * regrouped: all first bytes, all second bytes and so on, since corresponding bytes of neighbouring
 * tuples are similar. Buffers and contexts are kept between calls.
 */
class ColumnCodec
{
public:
  explicit ColumnCodec(Codec codec);
  ~ColumnCodec();
  ColumnCodec(const ColumnCodec&) = delete;
  ColumnCodec& operator=(const ColumnCodec&) = delete;

  /** Compresses tuples of `tupleBytes` bytes. Returns the compressed bytes, valid until the next
   * call, or `plain` itself if compression does not reduce the size. */
  std::span<const std::byte> compress(std::span<const std::byte> plain, std::size_t tupleBytes);

  /** Reverses compress() into `plain`, which has the correct size; returns false on failure. */
  bool decompress(
    std::span<const std::byte> stored, std::span<std::byte> plain, std::size_t tupleBytes);

private:
  struct Contexts;
  Codec Kind;
  std::unique_ptr<Contexts> Zstd;
  std::vector<std::byte> Regrouped, Packed;
};

} // namespace smg
