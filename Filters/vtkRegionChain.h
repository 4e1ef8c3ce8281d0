// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkAlgorithm;
class vtkMeshRegion;

namespace smg
{

/**
 * The first of the regions, one after the other, whose last one is `region`. What it gets has the
 * points that all of them hold some of, without the arrays that they add.
 */
vtkAlgorithm& firstOfChain(vtkMeshRegion& region);

} // namespace smg
