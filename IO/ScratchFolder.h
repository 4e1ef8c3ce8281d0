// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/ScratchFolder.h"

namespace smg
{

/** The path of a file in a scratch folder. */
inline std::filesystem::path operator/(const ScratchFolder& folder, const char* name)
{
  return folder.path() / name;
}

} // namespace smg
