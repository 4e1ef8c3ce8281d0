// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/BlockFile.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace smg
{

/**
 * Compresses and decompresses the columns of blocks. Before compression the bytes of the tuples are
 * regrouped: all first bytes, all second bytes and so on, since the same byte of neighbouring
 * tuples is alike. Buffers and contexts are kept from one call to the next.
 */
class ColumnCodec
{
public:
  explicit ColumnCodec(Codec codec);
  ~ColumnCodec();
  ColumnCodec(const ColumnCodec&) = delete;
  ColumnCodec& operator=(const ColumnCodec&) = delete;

  /**
   * Compresses tuples of `tupleBytes` bytes. Answers the compressed bytes, valid until the next
   * call, or `plain` itself if compression does not make it smaller.
   */
  std::span<const std::byte> compress(std::span<const std::byte> plain, std::size_t tupleBytes);

  /** Reverses compress() into `plain`, which has the right size; false if that is not possible. */
  bool decompress(
    std::span<const std::byte> stored, std::span<std::byte> plain, std::size_t tupleBytes);

private:
  struct Contexts;
  Codec Kind;
  std::unique_ptr<Contexts> Zstd;
  std::vector<std::byte> Regrouped, Packed;
};

} // namespace smg
