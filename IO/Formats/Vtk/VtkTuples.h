// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vtk/VtkArrayReader.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace smg
{

/** Converts `count` scalars of the file to the column type of the array. */
void convertVtkScalars(
  const VtkArray& array, const std::byte* from, std::size_t count, std::byte* to);

/** Reads tuples of a column in chunks and gives those to `take` of which `stays` says so. */
void copyVtkTuples(
  VtkArrayReader& reader, std::int64_t tuples, const auto& stays, bool allStay, const auto& take)
{
  const VtkArray& array = reader.array();
  const auto components = static_cast<std::size_t>(array.components);
  const std::size_t tupleBytes = components * sizeOf(array.columnType);
  const std::size_t chunk = std::max<std::size_t>(std::size_t(1 << 16) / (components * 8), 1);
  const bool converts = array.type != array.columnType;
  std::vector<std::byte> read(chunk * components * sizeOf(array.type));
  std::vector<std::byte> converted(converts ? chunk * tupleBytes : 0);
  for (std::int64_t left = tuples; left > 0;)
  {
    const auto count =
      static_cast<std::size_t>(std::min<std::int64_t>(left, static_cast<std::int64_t>(chunk)));
    reader.read(read.data(), count * components);
    std::byte* values = read.data();
    if (converts)
    {
      convertVtkScalars(array, read.data(), count * components, converted.data());
      values = converted.data();
    }
    std::size_t kept = allStay ? count : 0;
    for (std::size_t i = 0; i < count && !allStay; ++i)
    {
      if (stays())
      {
        std::memmove(values + kept++ * tupleBytes, values + i * tupleBytes, tupleBytes);
      }
    }
    take(std::span<const std::byte>(values, kept * tupleBytes));
    left -= static_cast<std::int64_t>(count);
  }
}

} // namespace smg
