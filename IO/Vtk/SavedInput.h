// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkAlgorithm;

namespace smg
{

/** Throws Error if what a writer is to save is made of a preview, without being a piece of its
 * mesh, or of the empty output of a filter that failed, or is no mesh. */
void checkSavedInput(vtkAlgorithm& writer);

} // namespace smg
