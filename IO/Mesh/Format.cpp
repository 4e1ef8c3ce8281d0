// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Mesh/Format.h"

#include "smg/Error.h"

namespace smg
{

void checkIsWhole(const MeshPart& part, const std::string& name)
{
  if (part.timeStep != 0)
  {
    throw Error(name + ": the file has no time steps (option --time-step).");
  }
  if (part.partition)
  {
    throw Error(name + ": the file has no partitions (option --partition).");
  }
}

} // namespace smg
