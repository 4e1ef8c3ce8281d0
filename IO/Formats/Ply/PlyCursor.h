// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/ByteOrder.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/TextScanner.h"
#include "IO/Formats/Ply/PlyHeader.h"
#include "smg/Column.h"

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace smg
{

/** The current record of a PLY file, for errors. */
struct PlyPlace
{
  const std::string* element = nullptr;
  std::int64_t record = 0;

  /** The sentence, preceded by the record. */
  std::string with(const std::string& sentence) const
  {
    return this->element ? "record " + std::to_string(this->record) + " of element " +
                             inQuotes(*this->element) + ": " + sentence
                         : sentence;
  }
};

/** Reads the numbers of a binary PLY body. */
template <std::endian Order>
class PlyBinaryCursor
{
public:
  PlyBinaryCursor(InputFile& file, std::size_t offset)
    : File(file)
    , EndOffset(offset)
  {
  }

  /** Begins record `record` of the element `element`, a string that must outlive the record. */
  void begin(const std::string& element, std::int64_t record)
  {
    this->Place = { &element, record };
  }

  /** The next number, of type T in the file. */
  template <class T>
  T take()
  {
    if (static_cast<std::size_t>(this->End - this->At) < sizeof(T))
    {
      this->moveTo(this->offset(), sizeof(T));
    }
    this->At += sizeof(T);
    return numberAt<T>(this->At - sizeof(T), Order);
  }

  double read(ScalarType type)
  {
    return dispatch(type, [this]<class T>(T) { return static_cast<double>(this->take<T>()); });
  }

  /** Skips `count` numbers. */
  void skip(ScalarType type, std::int64_t count)
  {
    const std::size_t bytes = sizeOf(type) * static_cast<std::size_t>(count);
    if (bytes > static_cast<std::size_t>(this->End - this->At))
    {
      // Checks that the last of them exists.
      this->moveTo(this->offset() + bytes - 1, 1);
      ++this->At;
      return;
    }
    this->At += bytes;
  }

  /** Whether `count` numbers can follow. */
  bool holds(ScalarType type, std::int64_t count) const
  {
    return static_cast<std::size_t>(count) <= this->left() / sizeOf(type);
  }

  std::size_t left() const { return this->File.size() - this->offset(); }

  /** Whether only blanks and zeros remain, which some programs write at the end. */
  bool atEnd()
  {
    constexpr std::string_view Filling("\0 \t\r\n", 5);
    for (; this->left() > 0; ++this->At)
    {
      if (this->At == this->End)
      {
        this->moveTo(this->offset(), 1);
      }
      if (Filling.find(*this->At) == std::string_view::npos)
      {
        return false;
      }
    }
    return true;
  }

  [[noreturn]] void fail(const std::string& sentence) const
  {
    this->File.fail(this->offset(), this->Place.with(sentence));
  }

private:
  std::size_t offset() const
  {
    return this->EndOffset - static_cast<std::size_t>(this->End - this->At);
  }

  /** Loads at least `least` bytes from `offset` on. */
  void moveTo(std::size_t offset, std::size_t least)
  {
    if (offset > this->File.size() || this->File.size() - offset < least)
    {
      this->fail("the file is truncated");
    }
    const std::string_view bytes = this->File.at(offset, least);
    this->At = bytes.data();
    this->End = bytes.data() + bytes.size();
    this->EndOffset = offset + bytes.size();
  }

  InputFile& File;
  const char* At = nullptr;
  const char* End = nullptr;
  std::size_t EndOffset; ///< position of the end in the file
  PlyPlace Place;
};

/** Reads the numbers of a PLY body in text. */
class PlyTextCursor
{
public:
  /** `helpers`: see TextScanner. */
  PlyTextCursor(InputFile& file, Workspace* helpers, std::size_t offset, std::int64_t line)
    : Scanner(file, '\0', helpers, offset, line)
  {
  }

  void begin(const std::string& element, std::int64_t record)
  {
    this->Place = { &element, record };
  }

  template <class T>
  T take()
  {
    const double value = this->Scanner.toNumber(this->Scanner.token(), "a property", false);
    if constexpr (std::numeric_limits<T>::is_integer)
    {
      if (value != std::floor(value) ||
          value < static_cast<double>(std::numeric_limits<T>::lowest()) ||
          value > static_cast<double>(std::numeric_limits<T>::max()))
      {
        this->fail(
          "a number is out of the range of its type " + std::string(nameOf(scalarTypeOf<T>())));
      }
    }
    return static_cast<T>(value);
  }

  double read(ScalarType type)
  {
    return dispatch(type, [this]<class T>(T) { return static_cast<double>(this->take<T>()); });
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

  std::size_t left() const { return this->Scanner.left(); }

  /** Whether only blanks remain. */
  bool atEnd() { return this->Scanner.atEnd(); }

  [[noreturn]] void fail(const std::string& sentence) const
  {
    this->Scanner.fail(this->Place.with(sentence));
  }

private:
  TextScanner Scanner;
  PlyPlace Place;
};

/** Calls f with a cursor at the beginning of the body. `helpers`: see TextScanner. */
template <class F>
decltype(auto) withPlyBody(InputFile& file, const PlyHeader& header, Workspace* helpers, F&& f)
{
  if (header.encoding == PlyEncoding::Ascii)
  {
    return f(PlyTextCursor(file, helpers, header.bodyOffset, header.bodyLine));
  }
  if (header.encoding == PlyEncoding::BigEndian)
  {
    return f(PlyBinaryCursor<std::endian::big>(file, header.bodyOffset));
  }
  return f(PlyBinaryCursor<std::endian::little>(file, header.bodyOffset));
}

} // namespace smg
