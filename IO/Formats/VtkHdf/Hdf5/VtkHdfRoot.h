// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace smg
{

/** The group of a file that everything stands in. */
inline const std::string VtkHdfRoot = "/VTKHDF/";

} // namespace smg
