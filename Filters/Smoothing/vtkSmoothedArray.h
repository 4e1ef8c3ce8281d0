// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

class vtkPointSet;

namespace smg
{

/** Sets `output` to the piece with other values in a point array, in its type: integers are rounded
 * to the nearest one that the type holds. */
void replaceArray(vtkPointSet& piece, const std::string& name, const std::vector<double>& values,
  vtkPointSet& output);

} // namespace smg
