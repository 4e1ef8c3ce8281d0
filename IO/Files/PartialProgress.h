// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"

#include <utility>

namespace smg
{

/** The progress function of a part of an operation, from `begin` to `end` of the whole. */
inline ProgressFunction partOf(ProgressFunction whole, double begin, double end)
{
  if (!whole)
  {
    return {};
  }
  return [whole = std::move(whole), begin, end](double done)
  { return whole(begin + done * (end - begin)); };
}

} // namespace smg
