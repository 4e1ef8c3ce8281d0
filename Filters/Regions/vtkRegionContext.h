// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Streaming/vtkInputStamp.h"
#include "IO/vtkPieceInput.h"
#include "Solver/Core/Progress.h"

#include <functional>
#include <string>

class vtkSelection;

namespace smg
{

/** What a region is sought in. */
struct RegionContext
{
  PieceInput& input; ///< of the region filter
  /** What is pulled to seek the region: the same points as of the input. */
  PieceInput& mesh;
  vtkSelection* selection;           ///< nullptr: none is connected
  std::function<InputStamp()> stamp; ///< of the mesh and the selection as they are now
  Progress& progress;
  std::function<void(const std::string&)> warn;
};

} // namespace smg
