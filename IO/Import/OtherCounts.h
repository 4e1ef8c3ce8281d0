// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <string>

namespace smg
{

/** The error of a format that needs the counts of a stream first, which turn out to be others. */
inline std::string otherCounts(const std::string& file, const StreamInfo& info)
{
  return file + ": the mesh stream does not have the " + std::to_string(info.vertices) +
         " vertices and " + std::to_string(info.cells) +
         " cells of its info: write it to a .vsm file first.";
}

} // namespace smg
