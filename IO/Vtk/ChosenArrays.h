// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <set>
#include <string>

class vtkAlgorithm;
class vtkAlgorithmOutput;

namespace smg
{

/** The names of the arrays of points and of cells that are chosen. */
struct ArrayChoice
{
  std::set<std::string> points, cells;
};

/** A filter that passes the chosen arrays of its input alone, with what every piece has: the arrays
 * of the piece contract, the marks of the conversion, the field data. It passes streamed requests
 * on. */
vtkSmartPointer<vtkAlgorithm> passChosenArrays(
  vtkAlgorithmOutput* input, const ArrayChoice& choice);

} // namespace smg
