// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/CellSelection.h"

#include <algorithm>
#include <vector>

namespace smg
{

void CellSelection::prepare(const MeshBlock& block, const std::filesystem::path& scratch)
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Columns.cellType()));
  std::vector<std::uint8_t> selected(block.corners.size() / corners);
  this->atCells({ block, 0, block.corners }, selected);
  this->Count += std::ranges::count(selected, 1);
  this->Tags.add(this->Test.column.in(block), selected);
  if (this->Place != DataPlace::Vertices)
  {
    return;
  }
  if (!this->Vertices)
  {
    this->Vertices.emplace(scratch);
  }
  this->Marks.append(block.vertices());
  this->Marked += block.vertices();
  for (std::size_t c = 0; c < selected.size(); ++c)
  {
    for (std::size_t k = c * corners; selected[c] && k < (c + 1) * corners; ++k)
    {
      *this->Marks.at(block.corners[k]) = 1;
    }
  }
  this->Vertices->append({ this->Marks.at(this->Written), this->Marks.at(block.finalized) });
  this->Written = block.finalized;
  this->Marks.release(this->Written);
}

void CellSelection::endPreparing(MeshParts* parts)
{
  this->Selection::endPreparing(parts);
  if (this->Vertices)
  {
    const std::span<std::uint8_t> marks{ this->Marks.at(this->Written),
      this->Marks.at(this->Marked) };
    if (parts)
    {
      parts->join(marks);
    }
    this->Vertices->append(marks);
    this->Vertices->finish();
    this->Marks.restart();
  }
}

void CellSelection::atCells(const CellRange& cells, std::span<std::uint8_t> selected) const
{
  const std::size_t valid =
    this->Test.apply(this->Test.column.in(cells.block), cells.first, selected);
  if (valid < selected.size())
  {
    this->Columns.fail(this->Key + ".mask",
      "is not a number in " + this->Columns.cellName(cells.block, cells.first + valid));
  }
}

void CellSelection::atFacets(const CellRange& cells, std::span<std::uint8_t> selected) const
{
  this->atCells(cells, selected);
  const auto all = static_cast<std::uint8_t>((1U << cornersOf(this->Columns.cellType())) - 1U);
  std::ranges::for_each(selected, [all](std::uint8_t& bits) { bits = bits ? all : 0; });
}

void CellSelection::select(const MeshBlock& block, std::span<std::uint8_t> selected)
{
  if (this->Vertices)
  {
    if (block.firstVertex == 0)
    {
      this->Vertices->rewind();
    }
    this->Vertices->read(selected);
  }
}

} // namespace smg
