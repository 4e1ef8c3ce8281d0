// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"

#include <cstdint>
#include <string>

namespace smg
{

/** The weight of an edge exceeds the range of numbers. */
class EdgeWeightError : public Error
{
public:
  /** The vertices, in the numbering of the cells, and their names in the message. */
  EdgeWeightError(std::int64_t fromVertex, std::int64_t toVertex, const std::string& fromName,
    const std::string& toName)
    : Error("the weight of the edge between vertices " + fromName + " and " + toName +
            " is too large: the cells there are almost flat; use uniform weights")
    , from(fromVertex)
    , to(toVertex)
  {
  }

  std::int64_t from, to;
};

} // namespace smg
