// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/TextScanner.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** Text in capital letters, of ASCII. */
std::string upperCase(std::string_view text);

/** A keyword line: `*ELEMENT, TYPE=C3D4, ELSET=body`. */
struct AbaqusKeyword
{
  std::string name;                              ///< "ELEMENT": in capitals, without the star
  std::map<std::string, std::string> parameters; ///< by their names in capitals; values as written

  bool has(const std::string& parameter) const { return this->parameters.contains(parameter); }
  /** Its value; empty: there is none. */
  std::string value(const std::string& parameter) const;
};

/** The lines of an input file of Abaqus or CalculiX: each keyword line with its data lines, whose
 * fields have commas between them. Comments and empty lines are passed. */
class AbaqusLines
{
public:
  explicit AbaqusLines(InputFile& file)
    : Scanner(file)
  {
  }

  /** Goes to the next keyword line, past data lines; false: the file ends. Throws Error. */
  bool next(AbaqusKeyword& keyword);
  /** Goes to the next data line of the keyword, whose fields are taken one by one; false: there is
   * none. */
  bool nextData();
  /** The next field of the data line, without blanks; none behind the last one. An empty field at
   * the end of a line that is continued does not count. */
  std::optional<std::string_view> field();

  /** The next field as a number. Throws MeshError, that it should be `what`. */
  std::int64_t integer(const char* what);
  /** The same; an absent or empty field is 0. */
  double real(const char* what);
  /** An integer that may be on one of the following lines. */
  std::int64_t integerInLines(const char* what);

  std::int64_t line() const { return this->LineNumber; }
  TextScanner& scanner() { return this->Scanner; }

private:
  bool peekLine();
  void take();

  TextScanner Scanner;
  std::string Line;            ///< the next or the current line
  std::int64_t LineNumber = 1; ///< of it
  std::size_t At = 0;          ///< in the current data line
};

} // namespace smg
