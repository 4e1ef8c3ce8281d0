// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace smg
{

/** What the system says of an error number, and what a user can do about it. */
std::string systemError(int errorNumber);

} // namespace smg
