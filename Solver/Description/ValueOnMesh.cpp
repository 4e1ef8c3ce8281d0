// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Description/ValueOnMesh.h"

#include <algorithm>

namespace smg
{

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

ValueOnMesh::ValueOnMesh(const DataValue& value, DataPlace place, const ValueRules& rules,
  const std::string& key, MeshColumns& columns)
  : Place(place)
  , Corners(cornersOf(columns.cellType()))
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
  this->Open = OpenValues<double>(this->Components);
}

void ValueOnMesh::requireRules(const DataValue& value, const ValueRules& rules,
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

void ValueOnMesh::startBlock(const MeshBlock& block)
{
  this->Current =
    this->What == OfVertices || this->What == OfCells ? &this->Values.in(block) : nullptr;
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
  for (std::size_t i = 0; i < static_cast<std::size_t>(block.vertices()); ++i)
  {
    this->atVertex(block, i, values.data() + i * static_cast<std::size_t>(this->Components));
  }
}

void ValueOnMesh::atVertex(const MeshBlock& block, std::size_t i, double* value) const
{
  if (this->What == Constant)
  {
    std::ranges::copy(this->Numbers, value);
    return;
  }
  if (this->What == Coordinates)
  {
    std::copy_n(block.positions.data() + 3 * i, 3, value);
    return;
  }
  for (int k = 0; k < this->Components; ++k)
  {
    value[k] = this->Current->value(i, k);
  }
}

void ValueOnMesh::atCell(std::size_t cell, const std::int64_t* corners, double* value) const
{
  if (this->What == Constant || this->What == OfCells)
  {
    this->atCorner(cell, 0, value);
    return;
  }
  for (int k = 0; k < this->Components; ++k)
  {
    double sum = 0.0;
    for (int corner = 0; corner < this->Corners; ++corner)
    {
      sum += this->Open.at(corners[corner])[k];
    }
    value[k] = sum / this->Corners;
  }
}

void ValueOnMesh::atCorner(std::size_t cell, std::int64_t corner, double* value) const
{
  if (this->What == Constant)
  {
    std::ranges::copy(this->Numbers, value);
  }
  else if (this->What == OfCells)
  {
    for (int k = 0; k < this->Components; ++k)
    {
      value[k] = this->Current->value(cell, k);
    }
  }
  else
  {
    std::copy_n(this->Open.at(corner), this->Components, value);
  }
}

} // namespace smg
