// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/vtkInputStamp.h"
#include "IO/vtkPieceInput.h"
#include "Solver/Core/Progress.h"

#include <functional>
#include <string>

class vtkSelection;

namespace smg
{

/** The data in which a region is searched. */
struct RegionContext
{
  PieceInput& input; ///< of the region filter
  /** The mesh to search: the same points as those of the input. */
  PieceInput& mesh;
  vtkSelection* selection;           ///< nullptr: not connected
  std::function<InputStamp()> stamp; ///< of the current mesh and selection
  Progress& progress;
  std::function<void(const std::string&)> warn;
};

} // namespace smg
