// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Engine/FreeComponents.h"

namespace smg
{
namespace
{

constexpr auto Block = static_cast<std::int64_t>(ComponentLabels::Block);

} // namespace

void FreeComponents::projectRightSide(LevelWindow<double>& level, std::vector<std::string>& notes)
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

void FreeComponents::fixMeans(LevelWindow<double>& level, std::vector<std::string>& notes)
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

void FreeComponents::shift(std::int64_t first, std::int64_t count, std::span<double> values)
{
  for (std::int64_t i = 0; !this->MeanShifts.empty() && i < count; ++i)
  {
    const std::int64_t vertex = first + i;
    const std::int64_t root =
      this->rootOf(this->Labels.block(vertex / Block)[static_cast<std::size_t>(vertex % Block)]);
    for (int k = 0; root >= 0 && k < this->Columns; ++k)
    {
      values[static_cast<std::size_t>(i * this->Columns + k)] -=
        this->MeanShifts[static_cast<std::size_t>(root * this->Columns + k)];
    }
  }
}

} // namespace smg
