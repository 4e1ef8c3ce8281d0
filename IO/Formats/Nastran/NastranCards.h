// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/TextScanner.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** The entries of a bulk data file of Nastran, with their continuation lines: in small fields of 8
 * characters, large ones of 16 (the name ends with a star), or free ones with commas. */
class NastranCards
{
public:
  explicit NastranCards(InputFile& file)
    : Scanner(file)
  {
  }

  /** Goes to the next entry; false: the file ends. Throws Error. */
  bool next();
  /** In capitals, without a star. */
  const std::string& name() const { return this->Name; }
  /** The fields behind the name. */
  std::size_t fields() const { return this->Fields.size(); }
  /** Field `i` from 0 on; empty: there is none. */
  std::string_view field(std::size_t i) const
  {
    return i < this->Fields.size() ? this->Fields[i] : std::string_view();
  }
  /** The same as a number; none: it is empty. Throws MeshError, that it should be `what`. */
  std::optional<std::int64_t> integer(std::size_t i, const char* what) const;
  std::optional<double> real(std::size_t i, const char* what) const;
  /** The same of a field that must not be empty. */
  std::int64_t requiredInteger(std::size_t i, const char* what) const;

  std::int64_t line() const { return this->LineNumber; }
  TextScanner& scanner() { return this->Scanner; }

private:
  bool peekLine();
  void addFields(bool isFirst);

  TextScanner Scanner;
  std::string Line; ///< the next one
  std::string Name;
  std::vector<std::string> Fields;
  std::int64_t LineNumber = 1; ///< of the entry
};

} // namespace smg
