// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace smg::testing
{

/** Thrown if a reader of files does what it must not do, for any bytes. */
class Finding : public std::logic_error
{
public:
  using std::logic_error::logic_error;
};

/** Throws Finding unless `condition` holds. */
inline void mustHold(bool condition, const char* what)
{
  if (!condition)
  {
    throw Finding(what);
  }
}

} // namespace smg::testing
