// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"

namespace smg
{

/** A file cannot be written since the disk is full, or the quota of the user is used up. */
class SMG_EXPORT DiskFull : public Error
{
public:
  using Error::Error;
};

} // namespace smg
