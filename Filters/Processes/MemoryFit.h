// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

class vtkMultiProcessController;
class vtkPointSet;

namespace smg
{

/** Whether the memory of the processes holds a problem. */
struct MemoryFit
{
  bool fits = false;
  std::string reason; ///< what is needed and what there is, for a note
};

/** Estimates the memory that the distributed engine needs for the pieces of all processes, with so
 * many right-hand sides. Called on all of them; returns the same on each. */
MemoryFit estimateMemoryFit(vtkPointSet& piece, vtkMultiProcessController* controller, int columns);

} // namespace smg
