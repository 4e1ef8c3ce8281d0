// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkAlgorithm;
class vtkMeshRegion;

namespace smg
{

/** The first of a chain of regions that ends at `region`. Its input has the points of the whole
 * chain, without the arrays that the regions add. */
vtkAlgorithm& firstOfChain(vtkMeshRegion& region);

} // namespace smg
