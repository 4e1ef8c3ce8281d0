// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/BinaryInput.h"
#include "IO/Files/TextScanner.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace smg
{

/** Reads the numbers of a Gmsh file, text or binary, with the same interface. Both have lines of
 * text around the numbers. Errors name the line, or the byte of a binary file. */
class GmshInput
{
public:
  /** `helpers`: see TextScanner. */
  GmshInput(InputFile& file, Workspace* helpers)
    : File(file)
    , Scanner(file, '\0', helpers)
    , Numbers(file, 0, std::endian::native)
  {
  }

  /** Reads the section $MeshFormat. Only 2.x, 4.0 and 4.1 have it. */
  void readFormat();
  bool hasFormat() const { return this->Version != 0; }
  /** For a file of version 1, which does not say so. */
  void setFirstVersion() { this->Version = 1; }
  bool isFirstVersion() const { return this->Version == 1; }
  /** Whether the version is 4.0 or 4.1, with blocks of nodes and elements. */
  bool hasBlocks() const { return this->Version == 4; }
  /** Whether it is 4.0, in which each node of a block has its tag, and tags are 32 bits. */
  bool isFourZero() const { return this->IsFourZero; }
  bool isBinary() const { return this->Binary; }

  /** The first word of the next line, "$..."; empty at the end of the file. */
  std::string sectionName();
  /** Skips the next line, which ends a section. */
  void endSection(const std::string& end);
  /** Skips everything up to and including this line. */
  void skipSection(const std::string& end);

  /** A line of the section $PhysicalNames, which is text in a binary file, too. */
  struct PhysicalName
  {
    int dimension;
    std::int64_t group;
    std::string name;
  };
  PhysicalName physicalName();

  /** What a section of data begins with: lines of text, also in a binary file. */
  struct DataHeader
  {
    std::string name;
    std::int64_t step = 0, components = 0, entries = 0;
  };
  /** Reads it; then entries follow, of a tag and `components` numbers each. */
  DataHeader dataHeader();

  /** A count in a line of text, of items of at least this many bytes. */
  std::int64_t lineCount(const char* what, std::size_t minText, std::size_t minBinary);
  /** To be called before numbers. */
  void beginNumbers();
  /** To be called before lines. */
  void endNumbers();

  // The next number: 32 bits, 64 bits or double precision in a binary file.
  std::int64_t integer(const char* what)
  {
    return this->Binary ? this->Numbers.take<std::int32_t>(what) : this->Scanner.integer(what);
  }
  std::int64_t longInteger(const char* what)
  {
    return this->Binary ? this->Numbers.take<std::int64_t>(what) : this->Scanner.integer(what);
  }
  double number(const char* what)
  {
    return this->Binary ? this->Numbers.take<double>(what) : this->Scanner.number(what);
  }
  /** The same, which need not be finite. */
  double anyNumber(const char* what)
  {
    return this->Binary ? this->Numbers.take<double>(what)
                        : this->Scanner.toNumber(this->Scanner.token(), what, false);
  }
  /** Skips `count` items of `bytes` bytes each in a binary file. */
  void skipNumbers(std::int64_t count, std::size_t bytes)
  {
    this->Numbers.skip(static_cast<std::size_t>(count) * bytes);
  }
  /** A count of following items, 64 bits, refused if the file cannot hold them. */
  std::int64_t count(const char* what, std::size_t minText, std::size_t minBinary);
  /** The same check for a number of any kind of a binary file that has been read. */
  void requireRoom(std::int64_t count, const char* what, std::size_t minBytes) const
  {
    const std::size_t left = this->InNumbers ? this->Numbers.left() : this->Scanner.left();
    if (!fitsInFile(count, minBytes, left))
    {
      this->fail(countError(count, what, left));
    }
  }

  /** Throws Error with the place, which MeshErrors lack. */
  [[noreturn]] void fail(const std::string& sentence) const;

private:
  InputFile& File;
  TextScanner Scanner;
  BinaryInput Numbers; ///< of a binary file
  int Version = 0;     ///< 1, 2 or 4; 0: unknown yet
  bool IsFourZero = false;
  bool Binary = false;
  bool InNumbers = false; ///< of a binary file
};

} // namespace smg
