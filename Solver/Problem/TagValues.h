// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** The values of a column until the one that is sought is found: what to name if it never is. */
class TagValues
{
public:
  /** Adds a part of the column, where `selected` is 1 at the value that is sought. */
  void add(const Column& column, std::span<const std::uint8_t> selected);

  /** For example ": its values are 1, 2 and 5", the smallest 10 of many, or only the range of more
   * than 1000; empty if the value was found or there is none. */
  std::string text() const;

private:
  static constexpr std::size_t Most = 1000;

  void add(double value);

  bool Found = false;
  std::vector<double> Values; ///< ascending; if there are more than Most, the first and the last
  bool IsRange = false;       ///< whether there are more
  bool IsSingle = false;      ///< whether the column has single precision
};

} // namespace smg
