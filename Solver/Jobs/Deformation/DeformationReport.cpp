// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Deformation/DeformationReport.h"

#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <cmath>
#include <string>

// What the streaming and the distributed engine have in common in their reports of a deformation.

namespace smg
{

void checkAnyHeld(const Report& report)
{
  if (report.prescribed == 0)
  {
    throw Error("no vertex of the mesh is held by a handle: there is nothing to deform it by");
  }
}

/** Checked as soon as the right-hand side is known: nothing could be computed from it. */
void checkMotions(double termSquares)
{
  if (!std::isfinite(termSquares))
  {
    throw Error("the deformed mesh leaves the range of numbers: use targets that are nearer, or "
                "clamped weights "
                "where cells are badly shaped");
  }
}

/** Neither is an error: the last handle counts, and a component without handles stays. */
void addDeformationNotes(Report& report)
{
  if (report.shared > 0)
  {
    report.notes.push_back(counted(report.shared, "vertex is", "vertices are") +
                           " held by more than one handle: the last one counts");
  }
  if (report.free_components > 0)
  {
    report.notes.push_back(
      std::to_string(report.free_components) + " of " +
      counted(report.components, "component", "components") +
      (report.free_components == 1 ? " has no held vertex: it stays as it is"
                                   : " have no held vertex: they stay as they are"));
  }
}

} // namespace smg
