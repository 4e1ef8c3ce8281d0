// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/InputFile.h"
#include "IO/Import/PlyHeader.h"
#include "IO/Import/TextScanner.h"
#include "Solver/Core/ScalarType.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace smg
{

/** Reads the numbers of a binary PLY body. `Swap`: the file's byte order is not the machine's. */
template <bool Swap>
class PlyBinaryCursor
{
public:
  PlyBinaryCursor(InputFile& file, std::size_t offset)
    : File(file)
    , At(file.begin() + offset)
  {
  }

  /** Begins record `record` of the element `element`. */
  void begin(const std::string& element, std::int64_t record)
  {
    this->Element = &element;
    this->Record = record;
    this->File.passed(static_cast<std::size_t>(this->At - this->File.begin()));
  }

  double read(ScalarType type)
  {
    return dispatch(type, [this]<class T>(T) { return static_cast<double>(this->take<T>()); });
  }

  /** Passes `count` numbers. */
  void skip(ScalarType type, std::int64_t count)
  {
    this->need(sizeOf(type) * static_cast<std::size_t>(count));
    this->At += sizeOf(type) * static_cast<std::size_t>(count);
  }

  /** Whether `count` numbers can follow. */
  bool holds(ScalarType type, std::int64_t count) const
  {
    return static_cast<std::size_t>(count) <= this->left() / sizeOf(type);
  }

  std::size_t left() const { return static_cast<std::size_t>(this->File.end() - this->At); }

  [[noreturn]] void fail(const std::string& sentence) const
  {
    this->File.fail(static_cast<std::size_t>(this->At - this->File.begin()),
      this->Element ? "record " + std::to_string(this->Record) + " of element " +
                        inQuotes(*this->Element) + ": " + sentence
                    : sentence);
  }

private:
  void need(std::size_t bytes) const
  {
    if (this->left() < bytes)
    {
      this->fail("the file is truncated");
    }
  }

  template <class T>
  T take()
  {
    this->need(sizeof(T));
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), this->At, sizeof(T));
    if constexpr (Swap)
    {
      std::reverse(bytes.begin(), bytes.end());
    }
    this->At += sizeof(T);
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }

  InputFile& File;
  const char* At;
  const std::string* Element = nullptr;
  std::int64_t Record = 0;
};

/** Reads the numbers of a PLY body in text. */
class PlyTextCursor
{
public:
  PlyTextCursor(InputFile& file, std::size_t offset, std::int64_t line)
    : File(file)
    , Scanner(file, '\0', offset, line)
  {
  }

  void begin(const std::string& element, std::int64_t record)
  {
    this->Element = &element;
    this->Record = record;
  }

  double read(ScalarType type)
  {
    const double value = this->Scanner.toNumber(this->Scanner.token(), "a property", false);
    if (type < ScalarType::Float32)
    {
      dispatch(type,
        [&]<class T>(T)
        {
          if (value != std::floor(value) ||
              value < static_cast<double>(std::numeric_limits<T>::lowest()) ||
              value > static_cast<double>(std::numeric_limits<T>::max()))
          {
            this->fail("a number is out of the range of its type " + std::string(nameOf(type)));
          }
        });
    }
    // The number that a binary file would have.
    return type == ScalarType::Float32 ? static_cast<double>(static_cast<float>(value)) : value;
  }

  void skip(ScalarType, std::int64_t count)
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      if (this->Scanner.token().empty())
      {
        this->fail("the file is truncated");
      }
    }
  }

  bool holds(ScalarType, std::int64_t count) const
  {
    return static_cast<std::size_t>(count) <= (this->left() + 1) / 2;
  }

  std::size_t left() const { return this->File.size() - this->Scanner.offset(); }

  [[noreturn]] void fail(const std::string& sentence) const
  {
    this->Scanner.fail(this->Element ? "record " + std::to_string(this->Record) + " of element " +
                                         inQuotes(*this->Element) + ": " + sentence
                                     : sentence);
  }

private:
  InputFile& File;
  TextScanner Scanner;
  const std::string* Element = nullptr;
  std::int64_t Record = 0;
};

/** Calls f with a cursor at the beginning of the body. */
template <class F>
decltype(auto) withPlyBody(InputFile& file, const PlyHeader& header, F&& f)
{
  constexpr bool bigEndianMachine = std::endian::native == std::endian::big;
  if (header.encoding == PlyEncoding::Ascii)
  {
    return f(PlyTextCursor(file, header.bodyOffset, header.bodyLine));
  }
  if ((header.encoding == PlyEncoding::BigEndian) == bigEndianMachine)
  {
    return f(PlyBinaryCursor<false>(file, header.bodyOffset));
  }
  return f(PlyBinaryCursor<true>(file, header.bodyOffset));
}

} // namespace smg
