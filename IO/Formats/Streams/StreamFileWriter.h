// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/SequentialOutput.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/Streams/StreamReaders.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace smg
{

/** Options of writing a streaming mesh file. */
struct StreamFileStyle
{
  enum Finalization
  {
    None,    ///< not at all
    InCell,  ///< by a negative, relative index in the last cell
    Explicit ///< by a separate line (text formats only)
  };
  Finalization finalization = InCell;
  bool bigEndian = false; ///< byte order of the data of the binary formats
  /** The byte for the order: 0 little, 1 big; -1: the true one. Some writers write a wrong one. */
  int endianFlag = -1;
};

/**
 * Writes a streaming mesh file element by element. The header specifies format, counts and bounds
 * (written if given), order and further values. finish() renames the file; without it nothing is
 * left. Every failure is an Error with the name of the file.
 */
class StreamFileWriter
{
public:
  virtual ~StreamFileWriter() = default;

  /** Writes the next vertex, with the further values of the header. */
  virtual void vertex(std::span<const float, 3> position, std::span<const float> floats = {},
    std::span<const std::int32_t> ints = {}) = 0;
  /** Writes a cell. `corners` count the vertices from 0; bit k of `finalMask` is set if no later
   * cell uses corners[k] (for only one of two equal corners). */
  virtual void cell(std::span<const std::int64_t> corners, unsigned finalMask = 0,
    std::span<const std::int32_t> ints = {}) = 0;
  /** Declares that no later cell uses the vertex, where a cell cannot: in text formats in
   * pre-order. The others cannot hold this, and nothing is written. */
  virtual void finalization(std::int64_t) {}
  /** Completes the file. Throws Error if the counts are not those of the header. */
  void finish();

protected:
  StreamFileWriter(
    std::filesystem::path path, const StreamFileHeader& header, const StreamFileStyle& style);

  [[noreturn]] void fail(const std::string& what) const;
  /** Whether the bounds of all values of a vertex are known, so that they can be written. */
  bool hasBounds() const;
  /** Least (upper false) or largest value `k` of the vertices. */
  float bound(int k, bool upper) const;
  /** Counts a vertex. */
  void countVertex(std::size_t floats, std::size_t ints);
  /** Counts a cell and makes of its corners the indices that stand in the file. */
  void countCell(std::span<const std::int64_t> corners, unsigned finalMask, std::size_t ints);
  /** Called by finish() when the counts are right. */
  virtual void complete() {}

  SequentialOutput Output;
  const StreamFileHeader Header;
  const StreamFileStyle Style;
  std::int64_t Vertices = 0, Cells = 0;
  std::array<std::int32_t, 4> Indices{};
};

/** Begins a file. Throws Error for counts beyond the 31 bits that the formats have. */
std::unique_ptr<StreamFileWriter> createStreamFile(
  std::filesystem::path path, const StreamFileHeader& header, const StreamFileStyle& style = {});

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
