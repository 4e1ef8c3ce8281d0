// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Files/TextNumbers.h"
#include "IO/Formats/Vtk/ByteSource.h"
#include "IO/Formats/Vtk/VtkArray.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** Reads the numbers of an array sequentially. The file must not be used otherwise meanwhile. */
class VtkArrayReader
{
public:
  /** Throws Error if the length of the array, if known, is not `array.values`. */
  VtkArrayReader(InputFile& file, const VtkArray& array, Pool& pool);

  /** Reads up to `count` numbers, in the machine's byte order; returns their number. */
  std::size_t readSome(std::byte* values, std::size_t count);
  /** Reads exactly `count` numbers. Throws Error if there are fewer. */
  void read(std::byte* values, std::size_t count);
  void skip(std::int64_t count);

  const VtkArray& array() const { return this->Array; }
  /** The total bytes of the numbers; -1 if unknown. */
  std::int64_t bytes() const;
  [[noreturn]] void fail(const std::string& sentence) const;

private:
  InputFile& File;
  const VtkArray Array;
  std::int64_t Left = -1; ///< numbers; -1: unknown
  std::optional<TextNumbers> Text;
  std::unique_ptr<ByteSource> Bytes;
};

/** Reads an array of integers of any type in chunks, as rows of given lengths. */
class VtkIndexReader
{
public:
  VtkIndexReader(InputFile& file, const VtkArray& array, Pool& pool);

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
  std::vector<std::byte> Bytes;
  std::vector<std::int64_t> Integers;
  std::size_t At = 0, End = 0;
};

} // namespace smg
