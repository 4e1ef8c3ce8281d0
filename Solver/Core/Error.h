// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace smg
{

/**
 * The exception of the library. Its message is meant for users: it names the file or parameter, the
 * location, the error and, if possible, a remedy. It is caught once, at the boundary: the command
 * line or a VTK class.
 */
class Error : public std::runtime_error
{
public:
  explicit Error(const std::string& sentence)
    : std::runtime_error(sentence)
  {
  }
};

/** Thrown if the progress callback cancels the operation. No files are left behind. */
class Cancelled : public Error
{
public:
  Cancelled()
    : Error("cancelled")
  {
  }
};

} // namespace smg
