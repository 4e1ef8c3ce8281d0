// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

class vtkPointSet;

namespace smg
{

/**
 * The number of components of the point or cell array of that name; `otherwise` if there is none.
 */
int componentsOf(vtkPointSet& mesh, const std::string& name, int otherwise);

} // namespace smg
