// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Coefficient.h"

#include "smg/CellWeights.h"

#include <algorithm>
#include <cmath>

namespace smg
{

namespace
{

/** Norms are sums of squares, which overflow for larger numbers. */
constexpr double MaxMagnitude = 1e150;

} // namespace

std::array<double, 6> tensorOf(const double* numbers, int count)
{
  std::array<double, 6> tensor{ numbers[0], numbers[0], numbers[0], 0.0, 0.0, 0.0 };
  std::copy_n(numbers, count == 1 ? 0 : count, tensor.begin());
  return tensor;
}

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
    this->Numbers = *value.numbers();
    this->Components = static_cast<int>(this->Numbers.size());
  }
  this->requireRules(value, rules, key, columns);
  this->Open = OpenValues<double>(columns.memory(), this->Components);
}

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
  this->Open.release(this->Finalized);
  this->Finalized = block.finalized;
  const std::span<double> values = this->Open.append(block.vertices());
  const InBlock given = this->in(block);
  for (std::size_t i = 0; i < static_cast<std::size_t>(block.vertices()); ++i)
  {
    given.atVertex(i, values.data() + i * static_cast<std::size_t>(this->Components));
  }
}

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

void Coefficient::InBlock::atCell(
  std::size_t cell, const std::int64_t* corners, double* value) const
{
  if (this->Value.What == Constant || this->Value.What == OfCells)
  {
    this->atCorner(cell, 0, value);
    return;
  }
  for (int k = 0; k < this->Value.Components; ++k)
  {
    double sum = 0.0;
    for (int corner = 0; corner < this->Value.Corners; ++corner)
    {
      sum += this->Value.Open.at(corners[corner])[k];
    }
    value[k] = sum / this->Value.Corners;
  }
}

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
