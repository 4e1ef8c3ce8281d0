// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

class vtkAlgorithm;
class vtkPointSet;

namespace smg
{

/** The arrays chosen with SetInputArrayToProcess() of a filter; an empty name: none. */
class ChosenArrays
{
public:
  /** Both arguments must outlive the object. */
  ChosenArrays(vtkAlgorithm& filter, vtkPointSet& input)
    : Filter(filter)
    , Input(input)
  {
  }

  /** The name of array `index`, of points or cells. */
  std::string named(int index) const;
  /** Array `index`; throws Error if it was chosen from the cells. */
  std::string ofPoints(int index) const;
  /** Array `index`, of the points or the cells; throws Error if both have one of that name. */
  std::string any(int index) const;

private:
  vtkAlgorithm& Filter;
  vtkPointSet& Input;
};

} // namespace smg
