// SPDX-License-Identifier: BSD-3-Clause
// In place of FilterDoor.cpp where there is no VTK.
#include "Testing/Random/Doors.h"

namespace smg::testing
{

Result solveFilter(const Case& given)
{
  return solveInMemory(given, given.run);
}

} // namespace smg::testing
