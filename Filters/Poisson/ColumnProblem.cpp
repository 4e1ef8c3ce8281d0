// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Poisson/ColumnProblem.h"

#include "Filters/Streaming/ColumnPlace.h"
#include "Solver/Core/Error.h"

#include <cmath>

namespace smg
{
namespace
{

int find(const StreamInfo& info, const std::string& name)
{
  if (name.empty())
  {
    return -1;
  }
  const int place = placeOfColumn(info.vertexColumns, name);
  if (place < 0)
  {
    throw Error("The mesh has no point array " + name + ": choose one that it has.");
  }
  return place;
}

} // namespace

ColumnProblem::ColumnProblem(
  const StreamInfo& info, const ColumnProblemNames& names, Weights weights, double screening)
  : Mask(find(info, names.mask))
  , Values(find(info, names.values))
  , Source(find(info, names.source))
  , Guess(find(info, names.guess))
  , WeightsOfEdges(weights)
  , Screening(screening)
{
  check(names);
  if (this->Mask >= 0 && info.vertexColumns[this->Mask].components != 1)
  {
    throw Error("The Dirichlet mask " + names.mask + " has several components: it must have one.");
  }
  for (const int column : { this->Values, this->Source, this->Guess })
  {
    if (column < 0)
    {
      continue;
    }
    const ColumnSpec& spec = info.vertexColumns[column];
    if (this->Columns != 0 && spec.components != this->Columns)
    {
      throw Error("The array " + spec.name + " has " + std::to_string(spec.components) +
                  " components where " + std::to_string(this->Columns) +
                  " are needed: values, source and initial guess must have the same number.");
    }
    this->Columns = spec.components;
  }
}

void ColumnProblem::check(const ColumnProblemNames& names)
{
  if (names.mask.empty() != names.values.empty())
  {
    throw Error("A Dirichlet mask and Dirichlet values belong together: choose both arrays, or "
                "neither.");
  }
  if (names.values.empty() && names.source.empty() && names.guess.empty())
  {
    throw Error("No array says what to solve: choose a Dirichlet mask with values, or a source.");
  }
}

double ColumnProblem::finite(
  const Column& column, const MeshBlock& block, std::int64_t vertex, int component) const
{
  const double value = column.value(vertex, component);
  if (!std::isfinite(value))
  {
    throw Error("The array " + column.spec.name +
                " has a value that is not a finite number at the "
                "point with GlobalId " +
                std::to_string(block.firstVertex + vertex) + ".");
  }
  return value;
}

void ColumnProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  const auto column = [&block](int place)
  { return place < 0 ? nullptr : &block.vertexColumns[place]; };
  const Column* mask = column(this->Mask);
  const Column* values = column(this->Values);
  const Column* source = column(this->Source);
  const Column* guess = column(this->Guess);
  for (std::int64_t vertex = 0; vertex < block.vertices(); ++vertex)
  {
    const bool isConstrained = mask && this->finite(*mask, block, vertex, 0) != 0.0;
    conditions.dirichlet[vertex] = isConstrained ? 0 : -1;
    conditions.screening[vertex] = this->Screening;
    // Values at free vertices are no one's business: they may be anything, also NaN.
    const Column* value = isConstrained ? values : guess;
    for (int k = 0; k < this->Columns; ++k)
    {
      const std::size_t place = vertex * this->Columns + k;
      conditions.value[place] = value ? this->finite(*value, block, vertex, k) : 0.0;
      conditions.source[place] = source ? this->finite(*source, block, vertex, k) : 0.0;
    }
  }
}

} // namespace smg
