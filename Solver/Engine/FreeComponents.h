// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/LevelWindow.h"
#include "Solver/Problem/ComponentLabels.h"
#include "Solver/Problem/Components.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/**
 * Makes the solution of components without constraint unique: their right-hand side loses its mean,
 * and they keep the mean of their initial values.
 */
class FreeComponents
{
public:
  FreeComponents(Components& components, ComponentLabels& labels, int columns)
    : Parts(components)
    , Labels(labels)
    , Columns(columns)
  {
  }

  /**
   * A component without constraint has a solution only if its right-hand side sums to zero: takes
   * the mean from it where it does not. Adds a note.
   */
  void projectRightSide(LevelWindow<double>& level, std::vector<std::string>& notes);

  /** After the solve: finds what shift() has to take from the values. Adds a note. */
  void fixMeans(LevelWindow<double>& level, std::vector<std::string>& notes);

  /** Shifts the values of vertices [first, first + count). */
  void shift(std::int64_t first, std::int64_t count, std::span<double> values);

private:
  std::int64_t rootOf(std::int32_t label) const { return label < 0 ? -1 : this->Parts.root(label); }

  Components& Parts;
  ComponentLabels& Labels;
  int Columns;
  std::vector<double> MeanShifts;
};

} // namespace smg
