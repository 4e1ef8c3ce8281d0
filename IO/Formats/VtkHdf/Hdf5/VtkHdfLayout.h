// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Mesh/MeshPart.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

class Hdf5File;

/** The description of the mesh of a VTKHDF file in a time step. */
struct VtkHdfLayout : VtkLayout
{
  std::vector<std::unique_ptr<VtkArrayOpener>> openers; ///< of the datasets
  std::int64_t timeSteps = 0;                           ///< of the file; 0: none
  std::int64_t partitions = 0;                          ///< of the time step
};

/**
 * Reads the layout of a file of the type UnstructuredGrid or PolyData, versions 1 and 2 (VTK File
 * Formats, "VTKHDF"). Each partition is a piece, whose cells name its own points. Throws Error if
 * it has another type or no such part, if counts are inconsistent, or if it needs more than
 * `mostBytes` of memory.
 */
VtkHdfLayout vtkHdfLayout(const Hdf5File& file, const MeshPart& part, std::int64_t mostBytes);

} // namespace smg
