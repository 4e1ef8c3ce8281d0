// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/CombinedSelection.h"

#include <algorithm>
#include <utility>

namespace smg
{

CombinedSelection::CombinedSelection(Combination::Kind kind,
  std::vector<std::unique_ptr<Selection>> parts, DataPlace place, const std::string& key,
  const MeshColumns& columns)
  : Selection(place, key, columns)
  , How(kind)
{
  for (std::unique_ptr<Selection>& part : parts)
  {
    const bool isLate = part->needsPreparing();
    this->Parts.push_back({ std::move(part), isLate });
  }
  this->IsLate = std::ranges::any_of(this->Parts, &Part::isLate);
}

bool CombinedSelection::needsPreparing() const
{
  return std::ranges::any_of(
    this->Parts, [](const Part& part) { return part.selection->needsPreparing(); });
}

void CombinedSelection::begin()
{
  this->Selection::begin();
  this->Vertices.reset();
  this->Read = 0;
  std::ranges::for_each(this->Parts, [](Part& part) { part.vertices.reset(); });
}

void CombinedSelection::combine(std::span<std::uint8_t> selected, std::uint8_t all, auto get) const
{
  const bool isAll = this->How == Combination::Kind::All;
  std::ranges::fill(selected, isAll ? all : std::uint8_t(0));
  for (const Part& part : this->Parts)
  {
    const std::span<const std::uint8_t> more = get(part);
    for (std::size_t i = 0; i < selected.size(); ++i)
    {
      selected[i] =
        static_cast<std::uint8_t>(isAll ? selected[i] & more[i] : selected[i] | more[i]);
    }
  }
  if (this->How == Combination::Kind::Not)
  {
    std::ranges::for_each(
      selected, [all](std::uint8_t& bits) { bits = static_cast<std::uint8_t>(bits ^ all); });
  }
}

void CombinedSelection::add(const MeshBlock& block, const std::filesystem::path& scratch)
{
  this->Scratch = scratch;
  for (Part& part : this->Parts)
  {
    part.selection->prepare(block, scratch);
  }
  this->Read += block.vertices();
  if (this->Place == DataPlace::Vertices && this->IsLate)
  {
    for (Part& part : this->Parts)
    {
      if (!part.isLate)
      {
        if (!part.vertices)
        {
          part.vertices = std::make_unique<VertexSetFile>(scratch);
        }
        part.vertices->append(part.selection->atVertices());
      }
    }
    return;
  }
  if (this->IsLate)
  {
    this->Count = 1;
    return;
  }
  const auto isSelected = [](std::uint8_t bits) { return bits != 0; };
  if (this->Place == DataPlace::Vertices)
  {
    const std::span<std::uint8_t> selected = this->open(block);
    this->combine(selected, 1, [](const Part& part) { return part.selection->atVertices(); });
    this->Count += std::ranges::count_if(selected, isSelected);
    return;
  }
  std::vector<std::uint8_t> selected(
    block.corners.size() / static_cast<std::size_t>(cornersOf(this->Columns.cellType())));
  const CellRange cells{ block, 0, block.corners };
  this->Place == DataPlace::Cells ? this->atCells(cells, selected)
                                  : this->atFacets(cells, selected);
  this->Count += std::ranges::count_if(selected, isSelected);
}

void CombinedSelection::endPreparing(MeshParts* parts)
{
  for (const Part& part : this->Parts)
  {
    part.selection->endPreparing(parts);
  }
  if (this->Place == DataPlace::Vertices && this->IsLate && !this->Vertices)
  {
    this->combineVertices();
  }
  this->Selection::endPreparing(parts);
}

/** Reads what the parts have found, as a stream of vertices that nothing else is known of. */
void CombinedSelection::combineVertices()
{
  constexpr std::int64_t Most = 8192;
  this->Vertices.emplace(this->Scratch);
  MeshBlock block;
  for (Part& part : this->Parts)
  {
    if (part.vertices)
    {
      part.vertices->finish();
    }
  }
  std::vector<std::uint8_t> selected;
  for (; block.firstVertex < this->Read; block.firstVertex = block.finalized)
  {
    block.finalized = std::min(this->Read, block.firstVertex + Most);
    selected.resize(static_cast<std::size_t>(block.finalized - block.firstVertex));
    block.positions.assign(3 * selected.size(), 0.0);
    for (Part& part : this->Parts)
    {
      if (part.isLate)
      {
        part.selection->startBlock(block);
      }
    }
    this->combine(selected, 1,
      [&](const Part& part) -> std::span<const std::uint8_t>
      {
        if (part.isLate)
        {
          return part.selection->atVertices();
        }
        this->OfPart.resize(selected.size());
        part.vertices->read(block.firstVertex, this->OfPart);
        return this->OfPart;
      });
    this->Vertices->append(selected);
    this->Count += std::ranges::count(selected, 1);
  }
  this->Vertices->finish();
  std::ranges::for_each(this->Parts, [](Part& part) { part.vertices.reset(); });
}

void CombinedSelection::select(const MeshBlock& block, std::span<std::uint8_t> selected)
{
  if (this->Vertices)
  {
    this->Vertices->read(block.firstVertex, selected);
    return;
  }
  for (const Part& part : this->Parts)
  {
    part.selection->startBlock(block);
  }
  this->combine(selected, 1, [](const Part& part) { return part.selection->atVertices(); });
}

void CombinedSelection::atCells(const CellRange& cells, std::span<std::uint8_t> selected) const
{
  this->OfPart.resize(selected.size());
  this->combine(selected, 1,
    [&](const Part& part) -> std::span<const std::uint8_t>
    {
      part.selection->atCells(cells, this->OfPart);
      return this->OfPart;
    });
}

void CombinedSelection::atFacets(const CellRange& cells, std::span<std::uint8_t> selected) const
{
  this->OfPart.resize(selected.size());
  const auto all = static_cast<std::uint8_t>((1U << cornersOf(this->Columns.cellType())) - 1U);
  this->combine(selected, all,
    [&](const Part& part) -> std::span<const std::uint8_t>
    {
      part.selection->atFacets(cells, this->OfPart);
      return this->OfPart;
    });
}

void CombinedSelection::atInnerFacets(
  const CellRange& cells, std::span<std::uint8_t> selected) const
{
  std::vector<std::uint8_t> inner(selected.size());
  std::ranges::fill(selected, std::uint8_t(0));
  for (const Part& part : this->Parts)
  {
    part.selection->atInnerFacets(cells, inner);
    for (std::size_t c = 0; c < inner.size(); ++c)
    {
      selected[c] |= inner[c];
    }
  }
  if (this->How != Combination::Kind::Any)
  {
    // Of all parts: those that are facets of each; of what is not selected none are.
    const bool isAll = this->How == Combination::Kind::All;
    this->atFacets(cells, inner);
    for (std::size_t c = 0; c < inner.size(); ++c)
    {
      selected[c] = isAll ? static_cast<std::uint8_t>(selected[c] & inner[c]) : std::uint8_t(0);
    }
  }
}

std::string CombinedSelection::predicate() const
{
  return this->How == Combination::Kind::All   ? "is in all of these parts"
         : this->How == Combination::Kind::Any ? "is in any of these parts"
                                               : "is outside of this part";
}

} // namespace smg
