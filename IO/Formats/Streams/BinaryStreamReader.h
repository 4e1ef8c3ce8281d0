// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/ByteOrder.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "Solver/Files/FileDescriptor.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace smg
{

/** Reads SMB and SVB. */
class BinaryStreamReader : public StreamFileReader
{
public:
  BinaryStreamReader(const std::filesystem::path& path, StreamFormat format);

  std::string place() const override;

private:
  bool read(StreamEvent& event) override;
  /** Moves to the next block; returns false at the end. */
  bool nextBlock();
  void readVertex(const std::byte* element, StreamEvent& event);
  void readCell(const std::byte* element, StreamEvent& event);

  std::endian Order = std::endian::native; ///< of the bytes of numbers
  int Corners;
  std::size_t ElementBytes;
  std::uint32_t Kinds = 0;                      ///< of the remaining elements of the block
  std::size_t Left = 0;                         ///< how many these are
  std::int64_t Element = -1, ElementOffset = 0; ///< the last one: its number and place
};

/** First bytes of the binary formats. */
constexpr std::uint8_t SmbVersion = 0;
constexpr std::uint8_t SvbVersion = 4;

/** Elements of a full block of the binary formats. */
constexpr int BinaryBlockElements = 32;

/** The beginning of a SMB or SVB file, and the byte order of its data. */
struct BinaryStreamHeader
{
  StreamFileHeader header;
  std::endian order = std::endian::native; ///< of the bytes of the data
  std::int64_t bodyOffset = 0;             ///< place of the first block
};

/**
 * Reads the beginning of a SMB or SVB file. The byte for the byte order is unreliable, since some
 * programs write a wrong one. Therefore the order is the one in which the header and the first
 * block are valid; if both are, the byte decides. Throws Error.
 */
BinaryStreamHeader readBinaryStreamHeader(const FileDescriptor& file, StreamFormat format);

} // namespace smg
