// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkArray.h"
#include "Solver/Memory/Buffer.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace smg
{

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
