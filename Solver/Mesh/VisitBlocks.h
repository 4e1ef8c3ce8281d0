// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"
#include "smg/MeshSource.h"

#include <algorithm>

namespace smg
{

/** Calls visit(block) for each block of a mesh and reports a progress from `begin` to `end`. Throws
 * Cancelled if the progress function returns false. */
template <class Visit>
void visitBlocks(
  MeshSource& mesh, const ProgressFunction& progress, double begin, double end, const Visit& visit)
{
  const auto cells = static_cast<double>(std::max<std::int64_t>(mesh.info().cells, 1));
  for (MeshBlock block; mesh.next(block);)
  {
    visit(block);
    const double done = std::min(1.0, static_cast<double>(block.firstCell) / cells);
    if (progress && !progress(begin + done * (end - begin)))
    {
      throw Cancelled();
    }
  }
}

} // namespace smg
