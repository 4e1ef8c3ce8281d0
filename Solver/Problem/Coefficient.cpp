// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Coefficient.h"

#include "smg/CellWeights.h"

#include <algorithm>
#include <cmath>

// A value of a description on its mesh: numbers, a column of the vertices or cells, or the
// position; at vertices, in cells, or at the corners of facets.
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

namespace
{

/** For example "1, 3 or 6". */
std::string choiceOf(const std::vector<int>& numbers)
{
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    text += i == 0 ? "" : i + 1 == numbers.size() ? " or " : ", ";
    text += std::to_string(numbers[i]);
  }
  return text;
}

} // namespace

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
    this->Values = columns.require(*name, rules.preferred, key);
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
      std::to_string(this->Components) + ", but must have " + choiceOf(rules.components);
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
  if (block.firstVertex == 0)
  {
    this->Open.restart();
    this->Finalized = 0;
  }
  // The cells of the previous block may have used what it finalised; they are done.
  this->Open.release(this->Finalized);
  this->Finalized = block.finalized;
  const std::span<double> values = this->Open.append(block.vertices());
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

} // namespace smg
