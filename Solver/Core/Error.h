// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace smg
{

/**
 * The one exception of the library. Its text is a sentence that a user can act on: it names the
 * file or parameter, the place, what is wrong and, where there is something to do, what to do.
 * It is caught once, at the boundary: the command line or a VTK class.
 */
class Error : public std::runtime_error
{
public:
  explicit Error(const std::string& sentence)
    : std::runtime_error(sentence)
  {
  }
};

/** Thrown when the progress callback asked to stop. Nothing is left behind. */
class Cancelled : public Error
{
public:
  Cancelled()
    : Error("cancelled")
  {
  }
};

} // namespace smg
