// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/SystemError.h"

#include <cerrno>
#include <system_error>

namespace smg
{
namespace
{

/** Empty: nothing that the system's own words do not say. */
const char* adviceOn(int errorNumber)
{
  switch (errorNumber)
  {
    case ENOSPC:
    case EDQUOT:
      return "; free space, or choose another folder";
    case EMFILE:
      return "; raise the limit of the process (ulimit -n)";
    case ENFILE:
      return "; close other programs";
    case EFBIG:
      return "; raise the limit of the process (ulimit -f), or choose another file system";
    case EIO:
      return "; check the disk and its connection";
    default:
      return "";
  }
}

} // namespace

std::string systemError(int errorNumber)
{
  return std::generic_category().message(errorNumber) + adviceOn(errorNumber);
}

} // namespace smg
