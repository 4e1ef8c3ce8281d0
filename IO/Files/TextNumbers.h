// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "smg/Column.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace smg
{

/**
 * Reads numbers of a text separated by blanks and line ends, up to a '<' or the end of the file.
 */
class TextNumbers
{
public:
  TextNumbers(InputFile& file, std::size_t begin)
    : File(file)
    , At(begin)
  {
  }

  /**
   * Reads up to `count` numbers as scalars of `type`; returns their number. Throws Error, with the
   * position, for a word that is not a number or that the type cannot represent. Finiteness is not
   * checked.
   */
  std::size_t read(ScalarType type, std::byte* values, std::size_t count);

  /** Skips up to `count` arbitrary words; returns their number. */
  std::int64_t skip(std::int64_t count);

  std::size_t offset() const { return this->At; }

private:
  /** The maximum length of a number. */
  static constexpr std::size_t MaxLetters = 512;

  /** The rest of the text from the next word on; empty at the end. */
  std::string_view rest();
  template <class T>
  std::size_t readAs(T* values, std::size_t count);

  InputFile& File;
  std::size_t At;
};

} // namespace smg
