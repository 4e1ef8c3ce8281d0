// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

class vtkPointSet;

namespace smg
{

/** Components of the array of that name of the points or the cells; `otherwise` if there is none.
 */
int componentsOf(vtkPointSet& mesh, const std::string& name, int otherwise);

} // namespace smg
