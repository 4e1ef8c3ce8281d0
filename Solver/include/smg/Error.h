// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <functional>
#include <stdexcept>
#include <string>

namespace smg
{

/**
 * The exception of the library. Its text is a sentence that a user can act on: it names the file or
 * parameter, the place, what is wrong and, where there is something to do, what to do.
 */
class SMG_EXPORT Error : public std::runtime_error
{
public:
  explicit Error(const std::string& sentence)
    : std::runtime_error(sentence)
  {
  }
};

/** Thrown when the progress callback asks to stop. Nothing is left behind. */
class SMG_EXPORT Cancelled : public Error
{
public:
  Cancelled()
    : Error("cancelled")
  {
  }
};

/**
 * A progress callback: called with the fraction done (0 to 1, never decreasing over a whole
 * operation); returns whether to continue. False ends the operation with Cancelled.
 */
using ProgressFunction = std::function<bool(double)>;

} // namespace smg
