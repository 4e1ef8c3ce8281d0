// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/SequentialInput.h"
#include "IO/Formats/Streams/StreamFile.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace smg
{

/** Reads SMA and SVA. */
class TextStreamReader : public StreamFileReader
{
public:
  TextStreamReader(const std::filesystem::path& path, StreamFormat format);

  std::string place() const override;

private:
  bool read(StreamEvent& event) override;
  void readHeader();
  void readComment(Tokens& tokens);
  std::int64_t headerNumber(Tokens& tokens, std::string_view key, std::int64_t least);
  void headerBounds(Tokens& tokens, bool upper);
  /** Reads the next line of the body into Line; returns false at the end. */
  bool nextBodyLine();
  void readVertex(Tokens& tokens, StreamEvent& event);
  void readCell(Tokens& tokens, StreamEvent& event);
  std::int64_t readIndex(Tokens& tokens, bool& final);

  std::array<double, 6> Bounds{};
  bool HasLower = false, HasUpper = false;
  int CellFloats = 0;
  std::int64_t CommentBytes = 0; ///< see StreamFileHeader
  char CellKey;
  bool Pending = false; ///< whether Line has not been parsed yet
  std::string_view Line;
};

} // namespace smg
