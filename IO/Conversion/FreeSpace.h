// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Text.h"

#include <cstdint>
#include <string>

namespace smg
{

/** "12 MiB are free", of freeBytes(); negative: there is no such folder to ask. */
inline std::string freeSpace(std::int64_t bytes)
{
  return bytes < 0 ? "the folder does not exist" : mebibytes(bytes) + " are free";
}

} // namespace smg
