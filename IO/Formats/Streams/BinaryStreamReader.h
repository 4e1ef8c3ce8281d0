// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Streams/StreamFile.h"

#include <bit>
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

} // namespace smg
