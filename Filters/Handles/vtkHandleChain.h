// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkAlgorithm;
class vtkMeshHandle;

namespace smg
{

/**
 * The first of the handles, one after the other, whose last one is `handle`. What it gets has the
 * points that all of them hold some of, without the arrays that they add.
 */
vtkAlgorithm& firstOfChain(vtkMeshHandle& handle);

} // namespace smg
