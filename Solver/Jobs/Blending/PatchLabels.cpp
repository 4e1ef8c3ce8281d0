// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Blending/PatchLabels.h"

#include "Solver/Problem/MeshColumns.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Labels of vertices from a column of patches. If the vertices have the column, its values are the
// labels. If the cells have it, a reading of the stream beforehand finds the vertices where cells
// of different patches meet, which are in no patch, and keeps one bit for each vertex on a scratch
// file. A cell without such a corner is in one patch, like all cells around it; one with such a
// corner lies between patches. So later readings need no numbers of patches.

namespace smg
{

namespace
{

/** Not a number equals nothing, not even itself: a cell with such a corner is never in one patch.
 */
constexpr double NoPatch = std::numeric_limits<double>::quiet_NaN();

} // namespace

PatchLabels::PatchLabels(const std::string& column, MeshColumns& columns)
  : Columns(columns)
  , Patch(columns.require(column, ColumnOwner::Vertices, "patch"))
  , Labels(columns.memory())
  , OnSeam(columns.memory())
{
  if (this->Patch.components != 1)
  {
    columns.fail("patch", "the column '" + column + "' has " +
                            std::to_string(this->Patch.components) +
                            " components, but must have one");
  }
}

double PatchLabels::at(const Column& column, std::size_t row, const MeshBlock& block) const
{
  const double label = column.value(row);
  // Different integers could become the same double, and patches be merged.
  const bool isTooLarge = isInexact(column.spec.type, label);
  if (std::isnan(label) || isTooLarge)
  {
    // `row` is a cell or a vertex of the block.
    const bool ofCells = this->Patch.owner == ColumnOwner::Cells;
    this->Columns.fail(
      "patch", "the column '" + this->Patch.name + "' " +
                 (isTooLarge ? "has an integer of 2^53 or more" : "is not a number") +
                 (ofCells ? " in " + this->Columns.cellName(block, row)
                          : " at " + this->Columns.vertexName(block, row)));
  }
  return label;
}

/** Marks the vertices of a block, and writes the marks of those that no later cell uses. */
void PatchLabels::prepare(const MeshBlock& block, const std::filesystem::path& scratch)
{
  if (this->Patch.owner != ColumnOwner::Cells)
  {
    return;
  }
  if (!this->Seam)
  {
    this->Seam.emplace(scratch);
  }
  std::ranges::fill(this->Labels.append(block.vertices()), NoPatch);
  this->OnSeam.append(block.vertices());
  this->Known += block.vertices();
  this->prepareCells(block);
  this->Seam->append({ this->OnSeam.at(this->Written), this->OnSeam.at(block.finalized) });
  this->Written = block.finalized;
  this->Labels.release(this->Written);
  this->OnSeam.release(this->Written);
}

/** Compares the patch of each cell with the patch of the first cell at each corner. Flagged cells
 * count, too, since they have a patch. */
void PatchLabels::prepareCells(const MeshBlock& block)
{
  const Column& column = this->Patch.in(block);
  const auto corners = static_cast<std::size_t>(cornersOf(this->Columns.cellType()));
  for (std::size_t c = 0; c < column.tuples(); ++c)
  {
    const double label = this->at(column, c, block);
    for (std::size_t k = c * corners; k < (c + 1) * corners; ++k)
    {
      double& first = *this->Labels.at(block.corners[k]);
      first = std::isnan(first) ? label : first;
      *this->OnSeam.at(block.corners[k]) |= static_cast<std::uint8_t>(first != label);
    }
  }
}

void PatchLabels::endPreparing()
{
  if (this->Seam)
  {
    this->Seam->append({ this->OnSeam.at(this->Written), this->OnSeam.at(this->Known) });
    this->Seam->finish();
    this->Labels.restart();
    this->OnSeam.restart();
  }
}

/** The labels of a block; with a column of the cells, 0 stands for any patch. */
void PatchLabels::read(const MeshBlock& block, std::span<double> labels)
{
  if (!this->Seam)
  {
    const Column& column = this->Patch.in(block);
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      labels[i] = this->at(column, i, block);
    }
    return;
  }
  this->Bits.resize(labels.size());
  this->Seam->read(block.firstVertex, this->Bits);
  std::ranges::transform(
    this->Bits, labels.begin(), [](std::uint8_t onSeam) { return onSeam ? NoPatch : 0.0; });
}

/** Later readings of a cell column need only the scratch file. */
std::vector<std::string> PatchLabels::vertexColumns() const
{
  return this->Seam ? std::vector<std::string>{} : std::vector{ this->Patch.name };
}

} // namespace smg
