// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <functional>
#include <stdexcept>
#include <string>

namespace smg
{

/** The exception of the library. Its message is meant for users: it names the file or parameter,
 * the location, the error and, if possible, a remedy. */
class SMG_EXPORT Error : public std::runtime_error
{
public:
  explicit Error(const std::string& sentence)
    : std::runtime_error(sentence)
  {
  }
};

/** Thrown if the progress callback cancels the operation. No files are left behind. */
class SMG_EXPORT Cancelled : public Error
{
public:
  Cancelled()
    : Error("cancelled")
  {
  }
};

/** A progress callback: called with the completed fraction (0 to 1, never decreasing during an
 * operation); returns whether to continue. False ends the operation with Cancelled. */
using ProgressFunction = std::function<bool(double)>;

} // namespace smg
