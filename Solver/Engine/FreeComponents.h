// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
 * and they keep the mean of their initial values. The finest level's State is told by nodes(),
 * rewriteB() and readX(), as LevelWindow has them.
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
  template <class State>
  void projectRightSide(State& level, std::vector<std::string>& notes);

  /** After the solve: finds what shift() has to take from the values. Adds a note. */
  template <class State>
  void fixMeans(State& level, std::vector<std::string>& notes);

  /** Shifts the values of vertices [first, first + count). */
  void shift(std::int64_t first, std::int64_t count, std::span<double> values);

private:
  static constexpr auto Block = static_cast<std::int64_t>(ComponentLabels::Block);

  std::int64_t rootOf(std::int32_t label) const { return label < 0 ? -1 : this->Parts.root(label); }

  Components& Parts;
  ComponentLabels& Labels;
  int Columns;
  std::vector<double> MeanShifts;
};

template <class State>
void FreeComponents::projectRightSide(State& level, std::vector<std::string>& notes)
{
  if (this->Parts.incompatibleSquares() == 0.0)
  {
    return;
  }
  const std::vector<double> shifts = this->Parts.rightSideShifts();
  level.rewriteB(
    [&](std::int64_t block, std::span<double> b)
    {
      const auto labels = this->Labels.block(block);
      for (std::size_t i = 0; i < labels.size(); ++i)
      {
        const std::int64_t root = this->rootOf(labels[i]);
        if (root >= 0 && this->Parts.isFree(static_cast<std::int32_t>(root)))
        {
          for (int k = 0; k < this->Columns; ++k)
          {
            b[i * static_cast<std::size_t>(this->Columns) + static_cast<std::size_t>(k)] -=
              shifts[static_cast<std::size_t>(root * this->Columns + k)];
          }
        }
      }
    });
  notes.push_back("the right-hand side of a component without prescribed value does not "
                  "sum to zero: its mean was taken from it");
}

template <class State>
void FreeComponents::fixMeans(State& level, std::vector<std::string>& notes)
{
  const std::int64_t components = this->Parts.freeComponents();
  if (components == 0)
  {
    return;
  }
  std::vector<double> sums(static_cast<std::size_t>(this->Parts.labels() * this->Columns));
  std::vector<double> values(static_cast<std::size_t>(Block * this->Columns));
  for (std::int64_t first = 0; first < level.nodes(); first += Block)
  {
    const auto labels = this->Labels.block(first / Block);
    level.readX(first, static_cast<std::int64_t>(labels.size()), values.data());
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      const std::int64_t root = this->rootOf(labels[i]);
      for (int k = 0; root >= 0 && k < this->Columns; ++k)
      {
        sums[static_cast<std::size_t>(root * this->Columns + k)] +=
          values[i * static_cast<std::size_t>(this->Columns) + static_cast<std::size_t>(k)];
      }
    }
  }
  this->MeanShifts = this->Parts.meanShifts(sums);
  notes.push_back(std::to_string(components) + " of " + std::to_string(this->Parts.components()) +
                  " components have no prescribed value: they keep the mean of their initial "
                  "values");
}

} // namespace smg
