// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/Base64.h"
#include "IO/Files/PositionedFile.h"
#include "smg/Column.h"

#include <cstdint>
#include <span>
#include <string>

namespace smg
{

/**
 * An array of a VTK XML file that is written in parts at its position within its element: its
 * number of bytes as UInt64, then its bytes, each a unit of base64. At most two bytes of the data
 * are buffered.
 */
class InlineArray
{
public:
  /** An array of `tuples` tuples. */
  InlineArray(ColumnSpec spec, std::int64_t tuples);

  /** The start tag of the element of the array. */
  std::string tag() const;

  /** Writes the number of bytes at this position of the file; returns the end of the array. */
  std::int64_t begin(PositionedFile& file, std::int64_t at);

  /** Writes the next tuples. Throws Error. */
  void append(PositionedFile& file, std::span<const std::byte> bytes);

  /** Writes the last characters after all tuples. Throws Error. */
  void finish(PositionedFile& file);

private:
  void write(PositionedFile& file, const std::string& text);

  ColumnSpec Spec;
  std::int64_t Bytes;
  std::int64_t At = 0; ///< position of the next characters
  Base64Encoder Encoder;
};

} // namespace smg
