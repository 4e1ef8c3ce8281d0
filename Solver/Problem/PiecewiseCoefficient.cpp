// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/PiecewiseCoefficient.h"

#include <algorithm>
#include <limits>

// A datum of a description on its mesh. First the entry that applies at each vertex, cell or facet
// of a block is found, of several the last one; then values are copied, entry by entry. So values
// are only evaluated where they apply: a column may have anything elsewhere, also NaN.

namespace smg
{

void PiecewiseCoefficient::add(
  const Where& where, const DataValue& value, const std::string& key, const std::string& valueKey)
{
  auto selection = Selection::make(where, this->Place, this->Rules.preferred, key, *this->Columns);
  // The selection may be null, for everywhere.
  this->Entries.push_back({ std::move(selection),
    Coefficient(value, this->Place, this->Rules, valueKey, *this->Columns), valueKey });
}

void PiecewiseCoefficient::add(const Datum& datum, const std::string& key)
{
  const std::vector<PlacedValue>& entries = datum.entries;
  if (entries.size() == 1 && std::holds_alternative<Everywhere>(entries[0].where))
  {
    // Written as a plain value in descriptions, without a list: its key has no index.
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

/** Only some kinds of selections do; others merely can be checked by a reading. */
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

/** All processes have the same entries and come here in the same order, as MeshParts requires. */
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

/** Also for entries that nothing in this block asks for: the values and marks of open vertices must
 * have no gaps. */
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

/** Later entries overwrite earlier ones wherever they apply. */
void PiecewiseCoefficient::entriesAtVertices(std::span<std::int32_t> entry) const
{
  // In ascending order, so that later entries take precedence.
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

/** Cells of a batch, not of the whole block: selections are asked for a range of cells. */
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

/** As in cells, with as many numbers per cell as it has corners. */
void PiecewiseCoefficient::entriesAtFacets(
  const CellRange& cells, std::span<std::int32_t> entry) const
{
  const auto facets = static_cast<std::size_t>(cornersOf(this->Columns->cellType()));
  // One byte per cell, with a bit per facet.
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

/** Constants have been checked when the description was read. `where` makes the text only if there
 * is an error. */
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

/** Entry by entry, so that the column of an entry is looked up once per call. */
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

/** Values are checked as they are used, so that an error can name the vertex. */
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

/** A conductivity may also come from a column of the vertices; then the mean is what is checked. */
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

/** One value for each corner of a facet, in the order of the corners in the cell. */
void PiecewiseCoefficient::valuesAtFacets(const CellRange& cells,
  std::span<const std::int32_t> entry, double* values, std::size_t stride) const
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Columns->cellType()));
  const auto on = [&](const Entry& given, const Coefficient::InBlock& value, std::size_t facet)
  {
    // A cell has as many facets as corners; facet k lacks corner k and has the others in their
    // order.
    const std::size_t c = facet / corners;
    double* numbers = values + facet * (corners - 1) * stride;
    for (std::size_t k = 0; k < corners; ++k)
    {
      if (k != facet % corners)
      {
        value.atCorner(cells.first + c, cells.corners[c * corners + k], numbers);
        // Most of these facets are in the interior, where the column may have anything. The solver
        // rejects NaN on boundary facets (ProblemFacets).
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
