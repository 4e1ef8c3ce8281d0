// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/Workspace.h"

#include <algorithm>

namespace smg
{

Workspace::Workspace(
  const std::filesystem::path& scratch, std::int64_t memory, const ProgressFunction& progress)
  : Folder(scratch)
  , Memory(std::max(memory, LeastMemory))
  , Reported(progress)
{
}

} // namespace smg
