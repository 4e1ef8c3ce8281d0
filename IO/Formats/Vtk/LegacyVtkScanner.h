// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/ByteSource.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace smg
{

/** The name under which numbers of a type are written to legacy VTK files. */
std::string_view legacyTypeName(ScalarType type);

/** Reads the words of a legacy VTK file and skips the arrays between them. */
class LegacyVtkScanner
{
public:
  explicit LegacyVtkScanner(InputFile& file)
    : File(file)
  {
  }

  /** Reads the three lines before the data. Throws Error if they are not those of such a file. */
  void readTitle();
  int majorVersion() const { return this->Version; }
  bool isBinary() const { return this->Binary; }

  /** The next word; empty at the end of the file. */
  std::string word();
  /** The next word in capital letters. */
  std::string keyword();
  /** The next word as a name, in which % and two hexadecimal digits encode a character. */
  std::string name();
  /** The next word, without consuming it. */
  std::string peek();
  /** The rest of the line, which is consumed. */
  std::string line() { return this->line(MaxLineBytes); }
  /** The next word as a count, not negative. */
  std::int64_t count(const char* what);

  /** Returns the array that begins after this line, of `values` numbers of the type named `type` in
   * the file, and skips it. Throws Error if the type is unknown or the file is too short. */
  VtkArray array(
    const std::string& name, const std::string& type, int components, std::int64_t values);
  /** Skips this number of texts; returns the last one, or its first `most` bytes. */
  std::string skipTexts(std::int64_t texts, std::size_t most);
  /** Skips this number of bits. */
  void skipBits(std::int64_t bits);

  [[noreturn]] void fail(const std::string& sentence) const { this->File.fail(this->At, sentence); }
  std::size_t offset() const { return this->At; }

private:
  static constexpr std::size_t MaxLineBytes = 4096;

  /** The first `most` bytes of the rest of the line. */
  std::string line(std::size_t most);
  void skipBlanks();
  void skipBytes(std::int64_t count, std::size_t size);

  InputFile& File;
  std::size_t At = 0;
  int Version = 0;
  bool Binary = false;
  char LineEnd = '\n';
};

} // namespace smg
