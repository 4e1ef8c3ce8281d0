// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"

#include <cstdint>
#include <string>

namespace smg
{

// What a front carries of its source is one number, by which fronts differ: that of the source,
// and, if it is asked for, above that the place of DistanceDescription::from that the source is of.
// -1 is no source.

/** The bits of the number of a source with a group. */
inline constexpr int SourceNumberBits = 42;

inline std::int64_t labelOf(std::int64_t number, std::int32_t group)
{
  if (number < 0 || number >> SourceNumberBits != 0)
  {
    throw Error("the number " + std::to_string(number) +
                " of a source is not from 0 to 2^42 - 1, as those with a group must be");
  }
  return std::int64_t{ group } << SourceNumberBits | number;
}

inline std::int64_t numberOfLabel(std::int64_t label)
{
  return label < 0 ? -1 : label & ((std::int64_t(1) << SourceNumberBits) - 1);
}

inline std::int64_t groupOfLabel(std::int64_t label)
{
  return label < 0 ? -1 : label >> SourceNumberBits;
}

} // namespace smg
