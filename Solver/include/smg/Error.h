// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <functional>
#include <stdexcept>
#include <string>

namespace smg
{

/**
 * The exception of the library. Its text is meant for users: it names the file or parameter, the
 * place, what is wrong and, if there is a remedy, what to do.
 */
class SMG_EXPORT Error : public std::runtime_error
{
public:
  /** An error with this text. */
  explicit Error(const std::string& sentence)
    : std::runtime_error(sentence)
  {
  }
};

/** Thrown when a ProgressFunction returns false. No partial output and no scratch file remains. */
class SMG_EXPORT Cancelled : public Error
{
public:
  /** With the text "cancelled". */
  Cancelled()
    : Error("cancelled")
  {
  }
};

/**
 * A progress callback: takes the fraction done, from 0 to 1, which never decreases during an
 * operation, and returns whether to continue. False ends the operation with Cancelled.
 */
using ProgressFunction = std::function<bool(double)>;

} // namespace smg
