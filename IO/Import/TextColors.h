// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Raw/RawMeshBuilder.h"

#include <cstdint>
#include <span>

namespace smg
{

/**
 * The column `Colors` that comes of numbers behind the vertices or the faces of a text file. The
 * first three or four decide: whole numbers up to 255, of which one is above 1, are bytes, others
 * numbers of single precision. Where not all are alike there is no column, which is noted.
 */
class TextColors
{
public:
  enum class Of : std::uint8_t
  {
    Vertices,
    Faces
  };

  TextColors(RawMeshBuilder& builder, Of of)
    : Builder(builder)
    , Owners(of)
  {
  }

  /** The numbers of the next vertex or face; if they are not three or four it has no colour. */
  void add(std::span<const double> numbers);

private:
  void begin(std::span<const double> numbers);
  bool fits(std::span<const double> numbers) const;
  void append(std::span<const std::byte> tuple);
  void drop();

  RawMeshBuilder& Builder;
  Of Owners;
  ColumnSpec Spec;
  int Column = -1;
  bool Begun = false, Dropped = false;
};

} // namespace smg
