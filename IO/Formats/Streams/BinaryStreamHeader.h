// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Streams/StreamFile.h"
#include "Solver/Storage/FileDescriptor.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace smg
{

/** First bytes of the binary formats. */
constexpr std::uint8_t SmbVersion = 0;
constexpr std::uint8_t SvbVersion = 4;

/** Elements of a full block of the binary formats. */
constexpr int BinaryBlockElements = 32;

/** A number of four bytes, whose order is `swapped` against the machine's. */
template <class T>
T loadNumber(const std::byte* bytes, bool swapped)
{
  static_assert(sizeof(T) == 4);
  std::uint32_t bits = 0;
  std::memcpy(&bits, bytes, 4);
  return std::bit_cast<T>(swapped ? __builtin_bswap32(bits) : bits);
}

/** The beginning of a SMB or SVB file, and the byte order of its data. */
struct BinaryStreamHeader
{
  StreamFileHeader header;
  bool swapped = false;        ///< the data is not in the byte order of this machine
  std::int64_t bodyOffset = 0; ///< place of the first block
};

/**
 * Reads the beginning of a SMB or SVB file. The byte that should tell the byte order is not to be
 * trusted: there are programs that write the wrong one. So the order is the one in which the
 * header and the first block make sense; only if both do, the byte decides. Throws Error.
 */
BinaryStreamHeader readBinaryStreamHeader(const FileDescriptor& file, StreamFormat format);

} // namespace smg
