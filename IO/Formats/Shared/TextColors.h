// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Shared/ImportColumn.h"

#include <cstdint>
#include <optional>
#include <span>

namespace smg
{

/**
 * The column `Colors` that comes of numbers behind the vertices or the faces of a text file, three
 * or four each. The first colour that is not black decides: whole numbers up to 255, of which one
 * is above 1, are bytes, others numbers of single precision up to 1. Where not all are alike there
 * is no column, which is noted.
 */
class TextColors
{
public:
  TextColors(RawMeshBuilder& builder, ImportColumn::Of of)
    : Builder(builder)
    , Owners(of)
  {
  }

  /** The numbers of the next vertex or face; if they are not three or four it has no colour. */
  void add(std::span<const double> numbers);
  /** After the last one. */
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
