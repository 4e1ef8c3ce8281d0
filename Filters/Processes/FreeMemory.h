// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace smg
{

/** The memory of this machine that programs can still have without swapping, bytes; 0: not known.
 */
std::int64_t freeMemory();

} // namespace smg
