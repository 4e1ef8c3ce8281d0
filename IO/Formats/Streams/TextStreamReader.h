// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/SequentialInput.h"
#include "IO/Files/Tokens.h"
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

  const StreamFileHeader& header() const override { return this->Header; }
  std::string name() const override { return this->Input.name(); }
  void next(StreamEvent& event) override;
  std::string place() const override;
  double fraction() const override;

private:
  [[noreturn]] void fail(const std::string& what) const;
  void readHeader();
  void readComment(Tokens& tokens);
  std::int64_t headerNumber(Tokens& tokens, std::string_view key, std::int64_t least);
  void headerBounds(Tokens& tokens, bool upper);
  /** Reads the next line of the body into Line; returns false at the end. */
  bool nextBodyLine();
  void readVertex(Tokens& tokens, StreamEvent& event);
  void readCell(Tokens& tokens, StreamEvent& event);
  std::int64_t readIndex(Tokens& tokens, bool& final);
  void checkEnd() const;

  SequentialInput Input;
  StreamFileHeader Header;
  std::array<double, 6> Bounds{};
  bool HasLower = false, HasUpper = false;
  int CellFloats = 0;
  char CellKey;
  bool Pending = false; ///< whether Line has not been parsed yet
  std::string_view Line;
  std::int64_t Vertices = 0, Cells = 0;
};

} // namespace smg
