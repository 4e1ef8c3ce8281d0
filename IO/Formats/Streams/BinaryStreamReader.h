// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/SequentialInput.h"
#include "IO/Formats/Streams/BinaryStreamHeader.h"
#include "IO/Formats/Streams/StreamFile.h"

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

  const StreamFileHeader& header() const override { return this->Begin.header; }
  std::string name() const override { return this->Input.name(); }
  void next(StreamEvent& event) override;
  std::string place() const override;
  double fraction() const override;

private:
  [[noreturn]] void fail(const std::string& what) const;
  /** Moves to the next block; returns false at the end. */
  bool nextBlock();
  void readVertex(const std::byte* element, StreamEvent& event);
  void readCell(const std::byte* element, StreamEvent& event);
  void checkEnd() const;

  SequentialInput Input;
  BinaryStreamHeader Begin;
  int Corners;
  std::size_t ElementBytes;
  std::uint32_t Kinds = 0;                      ///< of the remaining elements of the block
  std::size_t Left = 0;                         ///< how many these are
  std::int64_t Element = -1, ElementOffset = 0; ///< the last one: its number and place
  std::int64_t Vertices = 0, Cells = 0;
};

} // namespace smg
