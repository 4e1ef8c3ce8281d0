// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkStreamingMultigridIOModule.h"

#include "vtkSmartPointer.h"

#include <functional>

class vtkDataObject;
class vtkInformation;
class vtkPointSet;

namespace smg
{

/**
 * The mesh that a filter works on: the data itself, or the single block with cells of a data set of
 * several blocks, as an ordinary mesh (see lacksStreamNumbering()); null if the data are neither.
 * Throws Error if several blocks have cells, or the block is a preview, whose mesh cannot be
 * requested through other blocks, or there are several processes, which may have different blocks.
 */
VTKSTREAMINGMULTIGRIDIO_EXPORT vtkSmartPointer<vtkPointSet> meshOf(vtkDataObject* data);

/**
 * Does work that fills the output mesh, in the pipeline information `output`, of a filter. If it is
 * a data set of several blocks, as the data `input` are, the output is a mesh meanwhile, of the
 * type of meshOf(input), which then becomes that block of the output; the others are those of the
 * input.
 */
VTKSTREAMINGMULTIGRIDIO_EXPORT void throughSingleBlock(
  vtkDataObject* input, vtkInformation& output, const std::function<void()>& work);

} // namespace smg
