// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/PiecewiseCoefficient.h"

#include <algorithm>
#include <limits>

namespace smg
{

void PiecewiseCoefficient::add(
  const Where& where, const DataValue& value, const std::string& key, const std::string& valueKey)
{
  auto selection = Selection::make(where, this->Place, this->Rules.preferred, key, *this->Columns);
  this->Entries.push_back({ std::move(selection),
    Coefficient(value, this->Place, this->Rules, valueKey, *this->Columns), valueKey });
}

void PiecewiseCoefficient::add(const Datum& datum, const std::string& key)
{
  const std::vector<PlacedValue>& entries = datum.entries;
  if (entries.size() == 1 && std::holds_alternative<Everywhere>(entries[0].where))
  {
    this->add(entries[0].where, entries[0].value, key, key);
    return;
  }
  for (std::size_t k = 0; k < entries.size(); ++k)
  {
    const std::string place = key + '[' + std::to_string(k) + ']';
    this->add(entries[k].where, entries[k].value, place, place + ".value");
  }
}

bool PiecewiseCoefficient::selects() const
{
  return std::ranges::any_of(this->Entries, [](const Entry& e) { return e.where != nullptr; });
}

bool PiecewiseCoefficient::needsPreparing() const
{
  return std::ranges::any_of(
    this->Entries, [](const Entry& e) { return e.where && e.where->needsPreparing(); });
}

void PiecewiseCoefficient::prepare(const MeshBlock& block, const std::filesystem::path& scratch)
{
  for (Entry& entry : this->Entries)
  {
    if (entry.where)
    {
      entry.where->prepare(block, scratch);
    }
  }
}

void PiecewiseCoefficient::endPreparing(MeshParts* parts)
{
  for (Entry& entry : this->Entries)
  {
    if (entry.where)
    {
      entry.where->endPreparing(parts);
    }
  }
}

void PiecewiseCoefficient::startBlock(const MeshBlock& block)
{
  for (Entry& entry : this->Entries)
  {
    if (entry.where)
    {
      entry.where->startBlock(block);
    }
    entry.value.startBlock(block);
  }
}

void PiecewiseCoefficient::entriesAtVertices(std::span<std::int32_t> entry) const
{
  for (std::int32_t e = 0; e < this->entries(); ++e)
  {
    const Selection* where = this->at(e).where.get();
    if (!where)
    {
      std::ranges::fill(entry, e);
      continue;
    }
    const std::span<const std::uint8_t> selected = where->atVertices();
    for (std::size_t i = 0; i < entry.size(); ++i)
    {
      entry[i] = selected[i] ? e : entry[i];
    }
  }
}

void PiecewiseCoefficient::entriesAtCells(
  const CellRange& cells, std::span<std::int32_t> entry) const
{
  this->Selected.resize(entry.size());
  for (std::int32_t e = 0; e < this->entries(); ++e)
  {
    const Selection* where = this->at(e).where.get();
    if (!where)
    {
      std::ranges::fill(entry, e);
      continue;
    }
    where->atCells(cells, this->Selected);
    for (std::size_t c = 0; c < entry.size(); ++c)
    {
      entry[c] = this->Selected[c] ? e : entry[c];
    }
  }
}

void PiecewiseCoefficient::entriesAtFacets(
  const CellRange& cells, std::span<std::int32_t> entry) const
{
  const auto facets = static_cast<std::size_t>(cornersOf(this->Columns->cellType()));
  this->Selected.resize(entry.size() / facets);
  for (std::int32_t e = 0; e < this->entries(); ++e)
  {
    const Selection* where = this->at(e).where.get();
    if (!where)
    {
      std::ranges::fill(entry, e);
      continue;
    }
    where->atFacets(cells, this->Selected);
    for (std::size_t c = 0; c < this->Selected.size(); ++c)
    {
      for (std::size_t k = 0; k < facets; ++k)
      {
        entry[c * facets + k] = this->Selected[c] >> k & 1 ? e : entry[c * facets + k];
      }
    }
  }
}

void PiecewiseCoefficient::require(const Entry& entry, const double* numbers, auto where) const
{
  if (entry.value.isConstant())
  {
    return;
  }
  if (const char* complaint = this->Rules.complaint(numbers, entry.value.components()))
  {
    this->Columns->fail(entry.key, entry.value.name() + ' ' + complaint + where());
  }
}

void PiecewiseCoefficient::forEntries(
  const MeshBlock& block, std::span<const std::int32_t> entry, auto visit) const
{
  for (std::int32_t e = 0; e < this->entries(); ++e)
  {
    const Entry& given = this->at(e);
    const Coefficient::InBlock value = given.value.in(block);
    for (std::size_t k = 0; k < entry.size(); ++k)
    {
      if (entry[k] == e)
      {
        visit(given, value, k);
      }
    }
  }
}

void PiecewiseCoefficient::valuesAtVertices(const MeshBlock& block,
  std::span<const std::int32_t> entry, double* values, std::size_t stride) const
{
  const auto at = [&](const Entry& given, const Coefficient::InBlock& value, std::size_t i)
  {
    double* numbers = values + i * stride;
    value.atVertex(i, numbers);
    this->require(given, numbers, [&] { return " at " + this->Columns->vertexName(block, i); });
  };
  this->forEntries(block, entry, at);
}

void PiecewiseCoefficient::valuesAtCells(const CellRange& cells,
  std::span<const std::int32_t> entry, double* values, std::size_t stride) const
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Columns->cellType()));
  const auto in = [&](const Entry& given, const Coefficient::InBlock& value, std::size_t c)
  {
    double* numbers = values + c * stride;
    value.atCell(cells.first + c, cells.corners.data() + c * corners, numbers);
    this->require(given, numbers,
      [&] { return " in " + this->Columns->cellName(cells.block, cells.first + c); });
  };
  this->forEntries(cells.block, entry, in);
}

void PiecewiseCoefficient::valuesAtFacets(const CellRange& cells,
  std::span<const std::int32_t> entry, double* values, std::size_t stride) const
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Columns->cellType()));
  const auto on = [&](const Entry& given, const Coefficient::InBlock& value, std::size_t facet)
  {
    const std::size_t c = facet / corners;
    double* numbers = values + facet * (corners - 1) * stride;
    for (std::size_t k = 0; k < corners; ++k)
    {
      if (k != facet % corners)
      {
        value.atCorner(cells.first + c, cells.corners[c * corners + k], numbers);
        if (this->Rules.complaint(numbers, given.value.components()))
        {
          std::fill_n(numbers, given.value.components(), std::numeric_limits<double>::quiet_NaN());
        }
        numbers += stride;
      }
    }
  };
  this->forEntries(cells.block, entry, on);
}

} // namespace smg
