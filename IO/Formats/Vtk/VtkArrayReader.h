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

/** Reads the numbers of an array from first to last. Nobody else may use the file meanwhile. */
class VtkArrayReader
{
public:
  /** Throws Error if the array is not as long as `array.values` says, as far as is known. */
  VtkArrayReader(InputFile& file, const VtkArray& array, Pool& pool);

  /** Up to `count` numbers, in the machine's byte order; answers how many there were. */
  std::size_t readSome(std::byte* values, std::size_t count);
  /** Exactly `count` numbers. Throws Error if there are fewer. */
  void read(std::byte* values, std::size_t count);
  void skip(std::int64_t count);

  const VtkArray& array() const { return this->Array; }
  /** Bytes of the numbers in all; -1 if that is not known. */
  std::int64_t bytes() const;
  [[noreturn]] void fail(const std::string& sentence) const;

private:
  InputFile& File;
  const VtkArray Array;
  std::int64_t Left = -1; ///< numbers; -1: not known
  std::optional<TextNumbers> Text;
  std::unique_ptr<ByteSource> Bytes;
};

/** Reads an array of integers in chunks, whatever their type, as rows of given lengths. */
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
  /** Passes integers. */
  void skip(std::int64_t count);
  /** Whether there are no more. */
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
