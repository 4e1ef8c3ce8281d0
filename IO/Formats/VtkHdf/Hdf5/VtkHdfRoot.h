// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace smg
{

/** The root group of all data in a file. */
inline const std::string VtkHdfRoot = "/VTKHDF/";

} // namespace smg
