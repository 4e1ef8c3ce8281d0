// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/SequentialOutput.h"
#include "smg/Column.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace smg
{

/** Writes a text file. Numbers have the shortest representation that reads back exactly. finish()
 * renames the file; without finish() it is removed. */
class TextOutput
{
public:
  explicit TextOutput(const std::filesystem::path& path)
    : Out(path)
    , Text(BufferBytes)
  {
  }

  TextOutput& operator<<(std::string_view text)
  {
    if (text.size() > this->Text.size() - this->Used)
    {
      this->flush();
    }
    if (text.size() > this->Text.size())
    {
      this->Out.put(text);
      return *this;
    }
    std::memcpy(this->Text.data() + this->Used, text.data(), text.size());
    this->Used += text.size();
    return *this;
  }
  TextOutput& operator<<(char c) { return *this << std::string_view(&c, 1); }

  template <class Number>
  requires(std::integral<Number> || std::floating_point<Number>) TextOutput& operator<<(
    Number number)
  {
    if (this->Text.size() - this->Used < MaxDigits)
    {
      this->flush();
    }
    char* const begin = this->Text.data() + this->Used;
    this->Used +=
      static_cast<std::size_t>(std::to_chars(begin, begin + MaxDigits, number).ptr - begin);
    return *this;
  }

  /** Writes three coordinates with blanks between them, in this precision. */
  void position(std::span<const double> xyz, bool isDouble)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (axis > 0)
      {
        *this << ' ';
      }
      isDouble ? *this << xyz[axis] : *this << static_cast<float>(xyz[axis]);
    }
  }

  /** Writes the corners of an element with a blank before each; vertices are numbered from `first`.
   */
  void corners(std::span<const std::int64_t> corners, std::int64_t first)
  {
    for (const std::int64_t corner : corners)
    {
      *this << ' ' << corner + first;
    }
  }

  /** Writes a tuple of a column with a blank before each number; without a column `otherwise`. */
  void tuple(const std::vector<Column>& columns, std::ptrdiff_t column, std::size_t tuple,
    std::string_view otherwise = "")
  {
    if (column < 0)
    {
      *this << otherwise;
      return;
    }
    const Column& values = columns[static_cast<std::size_t>(column)];
    dispatch(values.spec.type,
      [&]<class T>(T)
      {
        const auto components = static_cast<std::size_t>(values.spec.components);
        for (const T value : values.as<T>().subspan(tuple * components, components))
        {
          *this << ' ' << value;
        }
      });
  }

  /** Writes all bytes to disk, so that only renaming is left. */
  void write()
  {
    this->flush();
    this->Out.flush();
  }
  void finish()
  {
    this->flush();
    this->Out.finish();
  }

private:
  static constexpr std::size_t BufferBytes = std::size_t(64) << 10;
  /** An upper bound of the characters of a number. */
  static constexpr std::size_t MaxDigits = 32;

  void flush()
  {
    this->Out.put(std::string_view(this->Text.data(), this->Used));
    this->Used = 0;
  }

  SequentialOutput Out;
  std::vector<char> Text;
  std::size_t Used = 0;
};

// How many characters TextOutput is expected to write, for estimates: numbers count with the blank
// or the end of the line after them.

/** Of a number below `count`, in the mean. */
inline double numberCharacters(std::int64_t count)
{
  // One of nine numbers is shorter than the longest, one of ninety by two digits ...
  return 1.9 + std::floor(std::log10(static_cast<double>(std::max<std::int64_t>(count, 1))));
}

/** Of a number with a fraction. The shortest text that reads back exactly has 7 to 9 digits, or 15
 * to 17; numbers from another text have fewer. */
inline double realCharacters(bool isDouble)
{
  return isDouble ? 17.5 : 10.0;
}

/** Of three coordinates. */
inline double positionCharacters(bool isDouble)
{
  return 3 * realCharacters(isDouble);
}

/** Of a tuple of column `column`, one of `columns`; none if it is negative: `otherwise`. */
inline double tupleCharacters(
  std::span<const ColumnSpec> columns, std::ptrdiff_t column, double otherwise = 0)
{
  if (column < 0)
  {
    return otherwise;
  }
  // Integers are colours, or the numbers of a few parts.
  constexpr double IntegerCharacters = 3;
  const ColumnSpec& spec = columns[static_cast<std::size_t>(column)];
  const bool isReal = spec.type == ScalarType::Float32 || spec.type == ScalarType::Float64;
  return spec.components *
         (isReal ? realCharacters(spec.type == ScalarType::Float64) : IntegerCharacters);
}

/** Of so many lines. */
inline std::int64_t textBytes(std::int64_t lines, double characters)
{
  return std::llround(static_cast<double>(lines) * characters);
}

} // namespace smg
