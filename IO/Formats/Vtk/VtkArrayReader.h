// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/MergeSort.h"
#include "IO/External/Workspace.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/TextNumbers.h"
#include "IO/Formats/Vtk/ByteSource.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** Reads the numbers of an array sequentially; another thread decodes the next ones ahead, unless
 * the array has an opener. The file must not be used otherwise meanwhile. */
class VtkArrayReader
{
public:
  /** Throws Error if the length of the array, if known, is not `array.values`. */
  VtkArrayReader(InputFile& file, const VtkArray& array, Workspace& workspace);
  VtkArrayReader(const VtkArrayReader&) = delete;
  VtkArrayReader& operator=(const VtkArrayReader&) = delete;

  /** The next numbers, at most `most`, in the machine's byte order, valid until the next call; none
   * at the end. */
  std::span<const std::byte> some(std::size_t most);
  /** Reads exactly `count` numbers. Throws Error if there are fewer. */
  void read(std::byte* values, std::size_t count);
  void skip(std::int64_t count);

  const VtkArray& array() const { return this->Array; }
  [[noreturn]] void fail(const std::string& sentence) const;
  /** Throws that there are fewer numbers; to be called only at the end. */
  [[noreturn]] void failShort() const;

private:
  void openBytes(Pool& pool);
  /** The bytes of memory to decode ahead. */
  std::size_t aheadMemory() const;
  /** Fills the span with the next numbers; returns their bytes, fewer only at the end. */
  std::size_t decode(std::span<std::byte> bytes);
  [[noreturn]] void failAt(std::size_t offset, const std::string& sentence) const;

  InputFile& File;
  const VtkArray Array;
  std::int64_t Left = -1; ///< numbers to decode; -1: unknown
  std::optional<TextNumbers> Text;
  std::unique_ptr<ByteSource> Bytes;
  std::vector<std::byte> Decoded;                ///< what an opener's source gives
  std::unique_ptr<RowPrefetch<std::byte>> Ahead; ///< of all other encodings
};

/** Reads an array of integers of any type in chunks, as rows of given lengths. */
class VtkIndexReader
{
public:
  VtkIndexReader(InputFile& file, const VtkArray& array, Workspace& workspace);

  /** The next `count` integers, valid until the next call. Throws Error if there are fewer. */
  std::span<const std::int64_t> next(std::size_t count)
  {
    if (this->End - this->At < count)
    {
      this->refill(count);
    }
    this->At += count;
    return { this->Integers.data() + this->At - count, count };
  }
  std::int64_t next() { return this->next(1)[0]; }
  /** Skips integers. */
  void skip(std::int64_t count);
  /** Whether the end is reached. */
  bool atEnd();
  [[noreturn]] void fail(const std::string& sentence) const { this->Values.fail(sentence); }

private:
  static constexpr std::size_t ChunkIntegers = 8192;

  void refill(std::size_t count);
  void readChunk();

  VtkArrayReader Values;
  std::vector<std::int64_t> Integers;
  std::size_t At = 0, End = 0;
};

} // namespace smg
