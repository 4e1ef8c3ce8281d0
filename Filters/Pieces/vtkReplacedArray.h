// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

class vtkPointSet;

namespace smg
{

/** Gives a point array of the mesh other values, in its type: integers are rounded to the nearest
 * one that the type holds. `values` has `stride` numbers a point; those of the array begin with
 * number `first`. Without such an array, as in a piece without points, nothing is done. Returns the
 * number of components of the array. */
std::size_t replaceArray(vtkPointSet& mesh, const std::string& name,
  const std::vector<double>& values, std::size_t first, std::size_t stride);

} // namespace smg
