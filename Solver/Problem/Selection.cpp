// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Selection.h"

#include "Solver/Problem/BoundarySelection.h"
#include "Solver/Problem/CellSelection.h"
#include "Solver/Problem/ColumnSelection.h"
#include "Solver/Problem/NearestSelection.h"
#include "Solver/Problem/RegionSelection.h"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace smg
{

namespace
{

/** Calls `visit(c, bits)` for each cell; bit k of `bits` is set if corner k is selected. */
void forCorners(
  CellType type, const CellRange& cells, const OpenValues<std::uint8_t>& open, auto visit)
{
  const auto corners = static_cast<std::size_t>(cornersOf(type));
  for (std::size_t c = 0; c < cells.corners.size() / corners; ++c)
  {
    unsigned bits = 0;
    for (std::size_t k = 0; k < corners; ++k)
    {
      bits |= static_cast<unsigned>(*open.at(cells.corners[c * corners + k])) << k;
    }
    visit(c, bits);
  }
}

} // namespace

std::unique_ptr<Selection> Selection::make(const Where& where, DataPlace place,
  ColumnOwner preferred, const std::string& key, MeshColumns& columns)
{
  if (std::holds_alternative<Everywhere>(where))
  {
    return nullptr;
  }
  if (const auto* region = std::get_if<Region>(&where))
  {
    return std::make_unique<RegionSelection>(*region, place, key, columns);
  }
  if (const auto* nearest = std::get_if<NearestVertices>(&where))
  {
    return std::make_unique<NearestSelection>(*nearest, place, key, columns);
  }
  if (std::holds_alternative<OnBoundary>(where))
  {
    return std::make_unique<BoundarySelection>(place, key, columns);
  }
  const auto ofColumn = [&](const std::string& name, const char* what,
                          std::optional<double> value) -> std::unique_ptr<Selection>
  {
    const NamedColumn column = columns.require(name, preferred, key + what);
    if (column.components != 1)
    {
      columns.fail(key + what, "the column '" + name + "' has " +
                                 std::to_string(column.components) +
                                 " components, but must have one");
    }
    const ColumnTest test{ column, value };
    if (column.owner == ColumnOwner::Cells)
    {
      return std::make_unique<CellSelection>(test, place, key, columns);
    }
    return std::make_unique<ColumnSelection>(test, place, key, columns);
  };
  if (const auto* tag = std::get_if<ColumnTag>(&where))
  {
    return ofColumn(tag->column, ".tag", tag->value);
  }
  return ofColumn(std::get<ColumnMask>(where).column, ".mask", std::nullopt);
}

void Selection::startBlock(const MeshBlock& block)
{
  if (block.firstVertex == 0)
  {
    this->Open.restart();
    this->Finalized = 0;
  }
  this->Open.release(this->Finalized);
  this->Finalized = block.finalized;
  const std::span<std::uint8_t> current = this->Open.append(block.vertices());
  this->select(block, current);
  this->Current = current;
}

void Selection::atCells(const CellRange& cells, std::span<std::uint8_t> selected) const
{
  const unsigned all = (1U << cornersOf(this->Columns.cellType())) - 1U;
  forCorners(this->Columns.cellType(), cells, this->Open,
    [&](std::size_t c, unsigned bits) { selected[c] = bits == all ? 1 : 0; });
}

void Selection::atFacets(const CellRange& cells, std::span<std::uint8_t> selected) const
{
  const int corners = cornersOf(this->Columns.cellType());
  const unsigned all = (1U << corners) - 1U;
  forCorners(this->Columns.cellType(), cells, this->Open,
    [&](std::size_t c, unsigned bits)
    {
      unsigned facets = 0;
      for (int k = 0; k < corners; ++k)
      {
        facets |= static_cast<unsigned>((bits | 1U << k) == all) << k;
      }
      selected[c] = static_cast<std::uint8_t>(facets);
    });
}

void Selection::prepare(const MeshBlock& block, const std::filesystem::path& /*scratch*/)
{
  this->startBlock(block);
  if (this->Place == DataPlace::Vertices)
  {
    this->Count += std::ranges::count(this->Current, 1);
    return;
  }
  const CellRange cells{ block, 0, block.corners };
  std::vector<std::uint8_t> selected(
    block.corners.size() / static_cast<std::size_t>(cornersOf(this->Columns.cellType())));
  this->Place == DataPlace::Cells ? this->atCells(cells, selected)
                                  : this->atFacets(cells, selected);
  this->Count += std::ranges::count_if(selected, [](std::uint8_t bits) { return bits != 0; });
}

void Selection::endPreparing(MeshParts* parts)
{
  if (parts)
  {
    parts->sum({ &this->Count, 1 });
  }
  if (this->Count == 0)
  {
    const char* what = this->Place == DataPlace::Vertices               ? "vertex"
                       : this->Place == DataPlace::Cells                ? "cell"
                       : this->Columns.cellType() == CellType::Triangle ? "edge"
                                                                        : "face";
    this->Columns.fail(this->Key, std::string("no ") + what + " of the mesh " + this->predicate() +
                                    (parts ? "" : this->instead()));
  }
}

} // namespace smg
