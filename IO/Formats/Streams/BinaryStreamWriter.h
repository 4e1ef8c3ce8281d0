// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Streams/BinaryStreamHeader.h"
#include "IO/Formats/Streams/StreamFileWriter.h"

#include <array>

namespace smg
{

/** Writes SMB and SVB. */
class BinaryStreamWriter : public StreamFileWriter
{
public:
  BinaryStreamWriter(
    std::filesystem::path path, const StreamFileHeader& header, const StreamFileStyle& style);

  void vertex(std::span<const float, 3> position, std::span<const float> floats,
    std::span<const std::int32_t> ints) override;
  void cell(std::span<const std::int64_t> corners, unsigned finalMask,
    std::span<const std::int32_t> ints) override;

private:
  void complete() override;
  void writeHeader();
  void writeFlag(bool flag);
  template <class T>
  void write(T value);
  template <class T>
  void addWord(T value);
  void endElement(bool isVertex);
  void flushBlock();

  bool Swapped;
  std::size_t ElementWords;
  std::uint32_t Kinds = 0;
  int Elements = 0;
  std::size_t Words = 0; ///< of the block
  std::array<std::uint32_t, 4 * BinaryBlockElements> Block{};
};

} // namespace smg
