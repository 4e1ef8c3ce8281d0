// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Coefficient.h"

#include "Solver/Core/Text.h"
#include "smg/CellWeights.h"

#include <algorithm>
#include <cmath>
#include <limits>

// A value of a description on its mesh: numbers, a column of the vertices or cells, or the
// position; at vertices, in cells, or at the corners of facets. And a datum, which has such a value
// in each part of the mesh: first the entry that applies at each vertex, cell or facet of a block
// is found, of several the last one; then values are copied, entry by entry. So values are only
// evaluated where they apply: a column may have anything elsewhere, also NaN.
//
// In a cell, a column of the vertices counts by the mean of the corners, and at a corner of a facet
// by its value there; both are needed after the vertices have been delivered, so the values of open
// vertices are kept. Constants and columns of the cells need no memory. Values are copied as they
// are or averaged over one cell: blocks do not change them.

namespace smg
{

namespace
{

/** Norms are sums of squares, which overflow for numbers somewhat above this one. */
constexpr double MaxMagnitude = 1e150;

} // namespace

/** In the order xx, yy, zz, xy, yz, xz of conductivityWeights(). */
std::array<double, 6> tensorOf(const double* numbers, int count)
{
  std::array<double, 6> tensor{ numbers[0], numbers[0], numbers[0], 0.0, 0.0, 0.0 };
  // One number is a multiple of the identity; three replace its diagonal, six all entries.
  std::copy_n(numbers, count == 1 ? 0 : count, tensor.begin());
  return tensor;
}

/** NaN passes only where it stands for a missing value. The magnitude is checked first: "must be
 * finite" would be a misleading message for 1e200. */
const char* ValueRules::complaint(const double* numbers, int count) const
{
  const bool isFinite = std::all_of(numbers, numbers + count,
    [this](double number)
    { return std::isfinite(number) || (this->missing && std::isnan(number)); });
  if (isFinite && std::any_of(numbers, numbers + count,
                    [](double number) { return std::abs(number) > MaxMagnitude; }))
  {
    return "must not be above 1e150 in magnitude, since its square would overflow";
  }
  switch (this->range)
  {
    case ValueRange::Any:
      return isFinite ? nullptr : "must be finite";
    case ValueRange::NotNegative:
      return isFinite && *std::min_element(numbers, numbers + count) >= 0.0
               ? nullptr
               : "must be finite and not negative";
    default:
      return isFinite && isPositiveDefinite(tensorOf(numbers, count).data())
               ? nullptr
               : "must be a positive number or a positive definite tensor";
  }
}

/** Resolves the value on the mesh: a name must belong to a column with an admissible number of
 * components. */
Coefficient::Coefficient(const DataValue& value, DataPlace place, const ValueRules& rules,
  const std::string& key, MeshColumns& columns)
  : Place(place)
  , Corners(cornersOf(columns.cellType()))
  , Open(columns.memory())
{
  if (value.isPosition())
  {
    this->What = Coordinates;
    this->Components = 3;
  }
  else if (const std::string* name = value.column())
  {
    this->Values = columns.require(*name, ownerOf(value, rules.preferred), key);
    this->What = this->Values.owner == ColumnOwner::Cells ? OfCells : OfVertices;
    this->Components = this->Values.components;
  }
  else
  {
    // Only constants can be checked now.
    this->Numbers = *value.numbers();
    this->Components = static_cast<int>(this->Numbers.size());
  }
  // Before the window of open vertices gets its number of components.
  this->requireRules(value, rules, key, columns);
  this->Open = OpenValues<double>(columns.memory(), this->Components);
}

/** Checks what is known without reading the mesh; values of columns are checked where they are
 * used. */
void Coefficient::requireRules(const DataValue& value, const ValueRules& rules,
  const std::string& key, const MeshColumns& columns) const
{
  if (this->What == Coordinates && !rules.positions)
  {
    columns.fail(key, "can be \"position\" only where there are 3 columns, and for values alone");
  }
  if (this->What == OfCells && this->Place == DataPlace::Vertices)
  {
    columns.fail(
      key, "'" + *value.column() + "' is a column of the cells: name one of the vertices");
  }
  if (std::ranges::find(rules.components, this->Components) == rules.components.end())
  {
    const std::string has =
      std::to_string(this->Components) + ", but must have " + listed(rules.components, "or");
    columns.fail(key, this->What == Constant
                        ? "the number of numbers is " + has
                        : "the components of the column '" + *value.column() + "' are " + has);
  }
  const char* complaint =
    this->What == Constant ? rules.complaint(this->Numbers.data(), this->Components) : nullptr;
  if (complaint)
  {
    columns.fail(key, complaint);
  }
}

/** Keeps the values at open vertices if cells or facets will ask for them. */
void Coefficient::startBlock(const MeshBlock& block)
{
  if (this->Place == DataPlace::Vertices || this->What == Constant || this->What == OfCells)
  {
    return;
  }
  const std::span<double> values = this->Open.startBlock(block);
  const InBlock given = this->in(block);
  for (std::size_t i = 0; i < static_cast<std::size_t>(block.vertices()); ++i)
  {
    // Not checked yet: a value that no entry uses may be anything.
    given.atVertex(i, values.data() + i * static_cast<std::size_t>(this->Components));
  }
}

/** The column is looked up by name once per block, not for each value. */
Coefficient::InBlock::InBlock(const Coefficient& value, const MeshBlock& block)
  : Value(value)
  , Block(block)
  , Rows(value.What == OfVertices || value.What == OfCells ? &value.Values.in(block) : nullptr)
{
}

void Coefficient::InBlock::copyRow(std::size_t row, double* value) const
{
  for (int k = 0; k < this->Value.Components; ++k)
  {
    value[k] = this->Rows->value(row, k);
  }
}

/** The place of the datum is the vertices here: a column of the cells has been refused. */
void Coefficient::InBlock::atVertex(std::size_t i, double* value) const
{
  if (this->Value.What == Constant)
  {
    std::ranges::copy(this->Value.Numbers, value);
  }
  else if (this->Value.What == Coordinates)
  {
    std::copy_n(this->Block.positions.data() + 3 * i, 3, value);
  }
  else
  {
    this->copyRow(i, value);
  }
}

/** The mean of the corners where the value is one of the vertices: exact for the integral of a
 * linear function over the cell. */
void Coefficient::InBlock::atCell(
  std::size_t cell, const std::int64_t* corners, double* value) const
{
  if (this->Value.What == Constant || this->Value.What == OfCells)
  {
    // The corner does not matter for these.
    this->atCorner(cell, 0, value);
    return;
  }
  for (int k = 0; k < this->Value.Components; ++k)
  {
    // Summed in the order of the corners in the mesh.
    double sum = 0.0;
    for (int corner = 0; corner < this->Value.Corners; ++corner)
    {
      sum += this->Value.Open.at(corners[corner])[k];
    }
    value[k] = sum / this->Value.Corners;
  }
}

/** A column of the cells has the value of the cell at each of its corners; others are taken from
 * the window. */
void Coefficient::InBlock::atCorner(std::size_t cell, std::int64_t corner, double* value) const
{
  if (this->Value.What == Constant)
  {
    std::ranges::copy(this->Value.Numbers, value);
  }
  else if (this->Value.What == OfCells)
  {
    this->copyRow(cell, value);
  }
  else
  {
    std::copy_n(this->Value.Open.at(corner), this->Value.Components, value);
  }
}

void PiecewiseCoefficient::add(
  const Where& where, const DataValue& value, const std::string& key, const std::string& valueKey)
{
  const Selection* selection = this->Parts->add(where, this->Place, this->Rules.preferred, key);
  this->Entries.push_back({ selection,
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

/** Also for entries that nothing in this block asks for: the values of open vertices must have no
 * gaps. */
void PiecewiseCoefficient::startBlock(const MeshBlock& block)
{
  for (Entry& entry : this->Entries)
  {
    entry.value.startBlock(block);
  }
}

/** In ascending order: later entries overwrite earlier ones wherever they apply. */
void PiecewiseCoefficient::entriesAtVertices(std::span<std::int32_t> entry) const
{
  for (std::int32_t e = 0; e < this->entries(); ++e)
  {
    this->entryAtVertices(e, entry);
  }
}

void PiecewiseCoefficient::entryAtVertices(std::int32_t e, std::span<std::int32_t> entry) const
{
  const Selection* where = this->at(e).where;
  if (!where)
  {
    std::ranges::fill(entry, e);
    return;
  }
  const std::span<const std::uint8_t> selected = where->atVertices();
  for (std::size_t i = 0; i < entry.size(); ++i)
  {
    entry[i] = selected[i] ? e : entry[i];
  }
}

/** Calls select(selection) for each entry, which sets `Selected`: a byte per cell with a bit for
 * each of its `places`. Cells of a batch, not of the whole block: selections are asked for a range
 * of cells. */
void PiecewiseCoefficient::select(
  std::span<std::int32_t> entry, std::size_t places, auto select) const
{
  this->Selected.resize(entry.size() / places);
  for (std::int32_t e = 0; e < this->entries(); ++e)
  {
    const Selection* where = this->at(e).where;
    if (!where)
    {
      std::ranges::fill(entry, e);
      continue;
    }
    select(*where);
    this->set(e, entry, places);
  }
}

void PiecewiseCoefficient::set(
  std::int32_t e, std::span<std::int32_t> entry, std::size_t places) const
{
  for (std::size_t c = 0; c < this->Selected.size(); ++c)
  {
    for (std::size_t k = 0; k < places; ++k)
    {
      entry[c * places + k] = this->Selected[c] >> k & 1 ? e : entry[c * places + k];
    }
  }
}

void PiecewiseCoefficient::entriesAtCells(
  const CellRange& cells, std::span<std::int32_t> entry) const
{
  this->select(entry, 1,
    [&](const Selection& where)
    {
      where.atCells(cells, this->Selected);
      where.checkCells(cells, this->Selected);
    });
}

void PiecewiseCoefficient::entriesAtFacets(
  const CellRange& cells, std::span<std::int32_t> entry) const
{
  this->select(entry, static_cast<std::size_t>(cornersOf(this->Columns->cellType())),
    [&](const Selection& where) { where.atFacets(cells, this->Selected); });
}

/** What holds everywhere on the boundary holds on no facet between cells, and takes none away. */
void PiecewiseCoefficient::entriesAtInnerFacets(
  const CellRange& cells, std::span<std::int32_t> entry) const
{
  const auto facets = static_cast<std::size_t>(cornersOf(this->Columns->cellType()));
  this->Selected.resize(entry.size() / facets);
  for (std::int32_t e = 0; e < this->entries(); ++e)
  {
    if (const Selection* const where = this->at(e).where)
    {
      where->atInnerFacets(cells, this->Selected);
      this->set(e, entry, facets);
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
