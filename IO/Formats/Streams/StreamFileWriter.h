// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/SequentialOutput.h"
#include "IO/Formats/Streams/StreamFile.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/**
 * Writes a streaming mesh file element by element, little-endian if it is binary. The header
 * specifies format, counts and bounds (written if given), order and further values. finish()
 * renames the file; without it nothing is left. Every failure is an Error with the name of the
 * file.
 */
class StreamFileWriter
{
public:
  virtual ~StreamFileWriter() = default;

  /** Writes the next vertex, with the further values of the header. */
  void vertex(std::span<const float, 3> position, std::span<const float> floats = {},
    std::span<const std::int32_t> ints = {});
  /** Writes a cell. `corners` count the vertices from 0; bit k of `finalMask` is set if no later
   * cell uses corners[k] (for only one of two equal corners). */
  void cell(std::span<const std::int64_t> corners, unsigned finalMask = 0,
    std::span<const std::int32_t> ints = {});
  /** Declares that no later cell uses the vertex, where a cell cannot: in text formats in
   * pre-order. The others cannot hold this, and nothing is written. */
  virtual void finalization(std::int64_t) {}
  /** Completes the file. Throws Error if the counts are not those of the header. */
  void finish();

protected:
  StreamFileWriter(std::filesystem::path path, const StreamFileHeader& header);

  [[noreturn]] void fail(const std::string& what) const;
  /** Least (upper false) or largest values of the vertices; none unless all of them are known. */
  std::vector<float> bounds(bool upper) const;
  /** Writes an element with its numbers, floats first. */
  virtual void put(
    StreamEvent::Kind kind, std::span<const float> floats, std::span<const std::int32_t> ints) = 0;
  /** Called by finish() when the counts are right. */
  virtual void complete() {}

  SequentialOutput Output;
  const StreamFileHeader Header;
  std::int64_t Vertices = 0, Cells = 0; ///< so far

private:
  /** Throws Error if an element has other numbers than the header says, or is one too many. */
  void checkElement(const char* what, std::int64_t count, bool hasAllNumbers) const;

  std::vector<float> Floats; ///< of the element
  std::vector<std::int32_t> Ints;
};

/** Begins a file. Throws Error for counts beyond the 31 bits that the formats have. */
std::unique_ptr<StreamFileWriter> createStreamFile(
  std::filesystem::path path, const StreamFileHeader& header);

} // namespace smg
