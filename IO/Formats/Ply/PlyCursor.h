// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/BinaryInput.h"
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
class PlyRecord
{
public:
  /** Begins record `number` of the element `element`, a string that must outlive the record. */
  void begin(const std::string& element, std::int64_t number)
  {
    this->Element = &element;
    this->Number = number;
  }

  /** The sentence, preceded by the record. */
  std::string inRecord(const std::string& sentence) const
  {
    return this->Element ? "record " + std::to_string(this->Number) + " of element " +
                             inQuotes(*this->Element) + ": " + sentence
                         : sentence;
  }

private:
  const std::string* Element = nullptr;
  std::int64_t Number = 0;
};

/** Reads the numbers of a binary PLY body. */
class PlyBinaryCursor : public BinaryInput, public PlyRecord
{
public:
  using BinaryInput::BinaryInput;

  double read(ScalarType type)
  {
    return dispatch(type, [this]<class T>(T) { return static_cast<double>(this->take<T>()); });
  }

  /** Skips `count` numbers. */
  void skip(ScalarType type, std::int64_t count)
  {
    this->BinaryInput::skip(sizeOf(type) * static_cast<std::size_t>(count));
  }

  /** Throws MeshError if the rest of the file cannot hold a list of this length. */
  void requireRoom(ScalarType type, std::int64_t length) const
  {
    this->BinaryInput::requireRoom(length, sizeOf(type), "the length of a list");
  }

  /** Whether only blanks and zeros remain, which some programs write at the end. */
  bool atEnd()
  {
    constexpr std::string_view Filling("\0 \t\r\n", 5);
    bool isFilling = true;
    while (isFilling && this->left() > 0)
    {
      isFilling = Filling.find(this->take<char>()) != std::string_view::npos;
    }
    return isFilling;
  }
};

/** Reads the numbers of a PLY body in text. */
class PlyTextCursor : public PlyRecord
{
public:
  /** `helpers`: see TextScanner. */
  PlyTextCursor(InputFile& file, Workspace* helpers, std::size_t offset, std::int64_t line)
    : Scanner(file, '\0', helpers, offset, line)
  {
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
        throw MeshError(
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
        throw MeshError("the file ends where a number should be");
      }
    }
  }

  void requireRoom(ScalarType, std::int64_t length) const
  {
    constexpr std::size_t MinBytes = 2; // a digit and a blank
    this->Scanner.requireRoom(length, MinBytes, "the length of a list");
  }

  /** Whether only blanks remain. */
  bool atEnd() { return this->Scanner.atEnd(); }

  [[noreturn]] void fail(const std::string& sentence) const { this->Scanner.fail(sentence); }

private:
  TextScanner Scanner;
};

/** Calls f with a cursor at the beginning of the body; a MeshError gets its place. `helpers`: see
 * TextScanner. */
void withPlyBody(InputFile& file, const PlyHeader& header, Workspace* helpers, const auto& f)
{
  const auto locating = [&f](auto cursor)
  {
    try
    {
      f(cursor);
    }
    catch (const MeshError& error)
    {
      cursor.fail(cursor.inRecord(error.what()));
    }
  };
  if (header.encoding == PlyEncoding::Ascii)
  {
    locating(PlyTextCursor(file, helpers, header.bodyOffset, header.bodyLine));
    return;
  }
  const bool isBig = header.encoding == PlyEncoding::BigEndian;
  locating(
    PlyBinaryCursor(file, header.bodyOffset, isBig ? std::endian::big : std::endian::little));
}

/** Reads the length of a list of numbers of this type. Throws MeshError if the file cannot hold it.
 */
std::int64_t readPlyLength(auto& cursor, ScalarType lengthType, ScalarType type)
{
  const auto length = static_cast<std::int64_t>(cursor.read(lengthType));
  cursor.requireRoom(type, length);
  return length;
}

} // namespace smg
