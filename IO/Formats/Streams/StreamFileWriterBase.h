// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/SequentialOutput.h"
#include "IO/Formats/Streams/StreamFileWriter.h"

#include <cstdint>
#include <filesystem>

namespace smg
{

/** The common part of the writers of text and binary files: counting and checking. */
class StreamFileWriterBase : public StreamFileWriter
{
public:
  StreamFileWriterBase(
    std::filesystem::path path, const StreamFileHeader& header, const StreamFileStyle& style);

  void finalization(std::int64_t) override {}
  void finish() override;

protected:
  [[noreturn]] void fail(const std::string& what) const;
  /** Whether the bounds of all values of a vertex are known, so that they can be written. */
  bool hasBounds() const;
  /** Least (upper false) or largest value `k` of the vertices. */
  float bound(int k, bool upper) const;
  /** Counts a vertex. */
  void countVertex(std::size_t floats, std::size_t ints);
  /** Counts a cell and converts its corners to the indices in the file. */
  void countCell(std::span<const std::int64_t> corners, unsigned finalMask, std::size_t ints);
  /** Called by finish() when the counts are right. */
  virtual void complete() {}

  SequentialOutput Output;
  const StreamFileHeader Header;
  const StreamFileStyle Style;
  std::int64_t Vertices = 0, Cells = 0;
  std::array<std::int32_t, 4> Indices{};
};

} // namespace smg
