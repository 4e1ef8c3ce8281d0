// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Blending/PatchGradients.h"

#include "Solver/Assembly/CellGradients.h"
#include "smg/CellWeights.h"

#include <algorithm>
#include <functional>

namespace smg
{

PatchGradients::PatchGradients(const VertexStorage& storage, Pool& open, CellType type, int columns)
  : Type(type)
  , Columns(static_cast<std::size_t>(columns))
  , File(storage, 1 + 3 * columns)
  , Points(open, 3)
  , Sums(open, 1 + 3 * columns)
  , Known(open, 1 + 3 * columns)
{
}

void PatchGradients::add(const MeshBlock& block, const PatchedValues& values)
{
  std::ranges::copy(block.positions, this->Points.append(block.vertices()).begin());
  std::ranges::fill(this->Sums.append(block.vertices()), 0.0);
  this->Vertices += block.vertices();
  const auto corners = static_cast<std::size_t>(cornersOf(this->Type));
  const Column* flags = block.flags(); // cells that have them have no weight
  for (std::size_t c = 0; corners * c < block.corners.size(); ++c)
  {
    const auto cell = std::span(block.corners).subspan(corners * c, corners);
    if (values.inOnePatch(cell) && (!flags || flags->value(c) == 0))
    {
      this->addCell(cell, values);
    }
  }
  this->append(block.finalized);
  this->Points.release(block.finalized);
  this->Sums.release(block.finalized);
}

void PatchGradients::addCell(std::span<const std::int64_t> corners, const PatchedValues& values)
{
  const double* point[4] = {};
  const double* value[4] = {};
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    point[k] = this->Points.at(corners[k]);
    value[k] = values.at(corners[k]);
  }
  const double measure = cellWeights(this->Type, point).measure;
  if (measure == 0.0)
  {
    return;
  }
  const CellGradients gradients(this->Type, point);
  for (std::size_t column = 0; column < this->Columns; ++column)
  {
    const Vector gradient = gradients.of(this->Type, value, static_cast<int>(column));
    for (const std::int64_t corner : corners)
    {
      double* sum = this->Sums.at(corner) + 1 + 3 * column;
      for (std::size_t d = 0; d < 3; ++d)
      {
        sum[d] += measure * gradient[d];
      }
    }
  }
  for (const std::int64_t corner : corners)
  {
    *this->Sums.at(corner) += measure;
  }
}

/** Appends the vertices below `end` to the file. */
void PatchGradients::append(std::int64_t end)
{
  if (end > this->Written)
  {
    const std::size_t lanes = 1 + 3 * this->Columns;
    this->File.append(
      { this->Sums.at(this->Written), static_cast<std::size_t>(end - this->Written) * lanes });
    this->Written = end;
  }
}

void PatchGradients::finish()
{
  this->append(this->Vertices);
  this->Points.restart();
  this->Sums.restart();
}

void PatchGradients::startBlock(const MeshBlock& block)
{
  if (block.firstVertex == 0)
  {
    this->Known.restart();
    this->Finalized = 0;
  }
  this->Known.release(this->Finalized);
  this->Finalized = block.finalized;
  if (block.vertices() > 0)
  {
    this->File.read(
      block.firstVertex, block.vertices(), this->Known.append(block.vertices()).data());
  }
}

void PatchGradients::average(
  std::span<const std::int64_t> corners, std::vector<double>& gradients) const
{
  gradients.assign(3 * this->Columns, 0.0);
  double measure = 0.0;
  for (const std::int64_t corner : corners)
  {
    const double* sum = this->Known.at(corner);
    measure += sum[0];
    std::transform(gradients.begin(), gradients.end(), sum + 1, gradients.begin(), std::plus<>());
  }
  if (measure > 0.0)
  {
    std::ranges::for_each(gradients, [measure](double& number) { number /= measure; });
  }
}

} // namespace smg
