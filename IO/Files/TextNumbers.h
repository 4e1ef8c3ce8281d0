// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "smg/Column.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace smg
{

/** Numbers of a text between blanks and line ends, up to a '<' or the end of the file. */
class TextNumbers
{
public:
  TextNumbers(InputFile& file, std::size_t begin)
    : File(file)
    , At(begin)
  {
  }

  /**
   * Reads up to `count` numbers as scalars of `type`, answers how many there were. Throws Error,
   * with the place, where there is no number, or one that the type does not have. Numbers that need
   * not be finite are not checked to be.
   */
  std::size_t read(ScalarType type, std::byte* values, std::size_t count);

  /** Passes up to `count` words, whatever they are; answers how many there were. */
  std::int64_t skip(std::int64_t count);

  std::size_t offset() const { return this->At; }

private:
  /** Longest word that is a number. */
  static constexpr std::size_t MostLetters = 512;

  /** The rest of the text from the next word on; empty at the end. */
  std::string_view rest();
  template <class T>
  std::size_t readAs(T* values, std::size_t count);

  InputFile& File;
  std::size_t At;
};

} // namespace smg
