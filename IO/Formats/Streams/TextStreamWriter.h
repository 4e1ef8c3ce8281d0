// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Streams/StreamFileWriter.h"

#include <string>

namespace smg
{

/** Writes SMA and SVA. */
class TextStreamWriter : public StreamFileWriter
{
public:
  TextStreamWriter(
    std::filesystem::path path, const StreamFileHeader& header, const StreamFileStyle& style);

  void vertex(std::span<const float, 3> position, std::span<const float> floats,
    std::span<const std::int32_t> ints) override;
  void cell(std::span<const std::int64_t> corners, unsigned finalMask,
    std::span<const std::int32_t> ints) override;
  void finalization(std::int64_t vertex) override;

private:
  void writeHeader();
  void writeBounds(const char* key, bool upper);
  void add(float value);
  void add(std::int64_t value);
  void endLine();

  std::string Line;
};

} // namespace smg
