// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/ImportColumn.h"

#include <cstdint>
#include <optional>
#include <span>

namespace smg
{

/**
 * The column `Colors` from the numbers after the vertices or the faces of a text file, three or
 * four each. The first colour that is not black determines the type: integers up to 255, at least
 * one of them above 1, are bytes; others are single precision numbers up to 1. If colours differ in
 * type, there is no column, with a note.
 */
class TextColors
{
public:
  TextColors(RawMeshBuilder& builder, ImportColumn::Of of)
    : Builder(builder)
    , Owners(of)
  {
  }

  /** Adds the numbers of the next vertex or face, which has no colour unless there are three or
   * four. */
  void add(std::span<const double> numbers);
  /** To be called after the last one. */
  void finish();

private:
  void begin(std::int64_t black, bool bytes);
  bool fits(std::span<const double> numbers) const;
  void append(std::span<const double> numbers);
  void drop();

  RawMeshBuilder& Builder;
  ImportColumn::Of Owners;
  std::optional<ImportColumn> Column;
  bool Bytes = false;
  std::size_t Components = 0; ///< of the first; 0: none
  std::int64_t Owned = 0;     ///< vertices or faces so far
  bool Dropped = false;
};

} // namespace smg
