// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/VsmFile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Reads positions of vertices of any precision as double precision numbers. Throws Error if one is
 * not finite. */
class PositionReader
{
public:
  /** The positions are `column` of `table`. */
  explicit PositionReader(VsmFile& file, int table = VsmFormat::Vertices, int column = 0)
    : File(file)
    , Rows(file.Blocks, table, column)
  {
  }

  /** Reads the positions of the vertices [first, first + count). */
  void read(std::int64_t first, std::int64_t count, double* positions)
  {
    this->convert(count, positions, [&](std::byte* to) { this->Rows.read(first, count, to); });
  }

  /** Reads the positions of the vertices `vertices`, in ascending order. */
  void gather(std::span<const std::int64_t> vertices, double* positions)
  {
    this->convert(static_cast<std::int64_t>(vertices.size()), positions,
      [&](std::byte* to) { this->Rows.gather(vertices, to); });
  }

private:
  template <class Read>
  void convert(std::int64_t count, double* positions, Read read)
  {
    if (this->Rows.tupleBytes() == 3 * sizeof(double))
    {
      read(reinterpret_cast<std::byte*>(positions));
    }
    else
    {
      this->Floats.resize(3 * count);
      read(reinterpret_cast<std::byte*>(this->Floats.data()));
      std::copy(this->Floats.begin(), this->Floats.end(), positions);
    }
    std::int64_t wrong = 0; // without a branch a number
    for (std::int64_t i = 0; i < 3 * count; ++i)
    {
      wrong |= static_cast<std::int64_t>(!std::isfinite(positions[i]));
    }
    if (wrong != 0)
    {
      this->File.fail("has a position that is not finite; make it anew.");
    }
  }

  const VsmFile& File;
  RowReader Rows;
  std::vector<float> Floats;
};

} // namespace smg
