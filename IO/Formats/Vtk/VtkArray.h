// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

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

} // namespace smg
