// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "Solver/Memory/Buffer.h"
#include "smg/Column.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** How the numbers of an array are written in a VTK file. */
enum class VtkEncoding : std::uint8_t
{
  Text,
  Raw, ///< unencoded bytes
  Base64
};

/** The compression of the bytes of an array, in blocks. */
enum class VtkCompression : std::uint8_t
{
  None,
  Zlib,
  Lz4,
  Lzma
};

class ByteSource;
class InputFile;
class Pool;
struct VtkArray;

/** Opens arrays whose numbers are not contiguous in the file. */
class VtkArrayOpener
{
public:
  virtual ~VtkArrayOpener() = default;
  /** The numbers from `array.begin` on, as `array.type` in the machine's byte order. */
  virtual std::unique_ptr<ByteSource> open(
    InputFile& file, const VtkArray& array, Pool& pool) const = 0;
};

/** An array of numbers in a VTK file: its type, position and encoding. */
struct VtkArray
{
  std::string name;
  ScalarType type = ScalarType::Float32;       ///< of the numbers in the file
  ScalarType columnType = ScalarType::Float32; ///< of the resulting column
  int components = 1;
  std::int64_t values = -1; ///< numbers, not tuples; -1: all
  std::size_t begin = 0;    ///< byte of the file
  VtkEncoding encoding = VtkEncoding::Text;
  VtkCompression compression = VtkCompression::None;
  std::endian byteOrder = std::endian::little;
  /** Bytes of a number of the header before data that are not text; 0: no header. */
  int headerBytes = 0;
  /** The object that opens it; then `begin` counts numbers. Null: it is in the file as described
   * above. */
  const VtkArrayOpener* opener = nullptr;
  bool isFractions = false; ///< numbers from 0 to 1 for bytes from 0 to 255
};

/** The consecutive bytes of a file, in any encoding. */
class ByteSource
{
public:
  virtual ~ByteSource() = default;

  /** Fills the span. Throws Error, with the position, if the file does not have that many bytes. */
  virtual void read(std::span<std::byte> bytes) = 0;

  /** An unsigned integer of 4 or 8 bytes. */
  std::uint64_t integer(int bytes, std::endian order);
};

/** Unencoded bytes of the file. */
class RawBytes : public ByteSource
{
public:
  RawBytes(InputFile& file, std::size_t begin)
    : File(file)
    , At(begin)
  {
  }
  void read(std::span<std::byte> bytes) override;

private:
  InputFile& File;
  std::size_t At;
};

/** Bytes that are encoded in base64, in one unit or, each with its padding, several. */
class Base64Bytes : public ByteSource
{
public:
  Base64Bytes(InputFile& file, std::size_t begin)
    : File(file)
    , At(begin)
  {
  }
  void read(std::span<std::byte> bytes) override;

private:
  /** Decodes groups without blanks and padding; returns the number of bytes. */
  std::size_t decodeRun(std::span<std::byte> bytes);
  void decodeGroup();

  InputFile& File;
  std::size_t At;
  std::array<std::byte, 3> Group{};
  std::size_t Size = 0, Used = 0; ///< bytes of the group
};

/** Bytes compressed by VTK in blocks. Their header has the number of blocks, the bytes of a block
 * and of the last one, 0 if it is as large as the others, and the compressed size of each block. */
class CompressedBytes : public ByteSource
{
public:
  /** Throws Error if the header is invalid, and like Pool, whose memory the blocks use. */
  CompressedBytes(InputFile& file, const VtkArray& array, Pool& pool);
  void read(std::span<std::byte> bytes) override;

  /** Bytes in all. */
  std::uint64_t bytes() const { return this->Bytes; }

private:
  void nextBlock();
  std::uint64_t nextSize();

  InputFile& File;
  const VtkArray& Array;
  std::unique_ptr<ByteSource> Sizes, Data;
  std::uint64_t Blocks = 0, BlockBytes = 0, LastBytes = 0, Bytes = 0;
  std::uint64_t Block = 0;          ///< the next one
  std::vector<std::uint64_t> Known; ///< compressed sizes read at once
  Buffer Compressed, Plain;
  std::size_t Size = 0, Used = 0; ///< bytes of the block
};

/** The bytes at a position, in base64 or not. */
std::unique_ptr<ByteSource> bytesAt(InputFile& file, VtkEncoding encoding, std::size_t begin);

} // namespace smg
