// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/OpenVertices.h"

#include "Solver/Mesh/AddedColumn.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

// The data of open vertices: what the stream and the problem give for each vertex, once and in
// stream order, and what its cells sum up to. All numbers of a problem are checked here, where the
// vertex can still be named: one NaN would make the whole solution NaN.

namespace smg
{

std::ptrdiff_t Density::findInvalid(const double* numbers, std::size_t count) const
{
  const double* end = numbers + count;
  const double* found = std::find_if_not(numbers, end,
    [this](double number)
    { return std::isfinite(number) && (this->mayBeNegative || number >= 0.0); });
  return found == end ? -1 : found - numbers;
}

namespace
{

template <std::size_t... Index>
std::array<Ring<double>, sizeof...(Index)> densityRings(
  Pool& pool, int columns, std::index_sequence<Index...>)
{
  return { Ring<double>(pool, Densities[Index].numbers(columns))... };
}

} // namespace

OpenVertices::OpenVertices(Pool& pool, Problem& problem, Solution* solution)
  : ties(pool, problem)
  , points(pool, 3)
  , values(pool, problem.columns())
  , rest(pool, problem.columns())
  , dirichlet(pool)
  , densities(densityRings(pool, problem.columns(), std::make_index_sequence<Densities.size()>()))
  , mass(pool)
  , scale(pool)
  , Given(problem)
  , Solved(solution)
  , HasRest(solution && solution->hasRest())
  , Reserved(pool)
  , Columns(problem.columns())
  , DirichletCount(problem.conditionCounts().dirichlet)
{
}

void OpenVertices::forGiven(const MeshBlock& block, auto visit)
{
  visit(this->points, block.positions);
  visit(this->values, this->Conditions.value);
  visit(this->dirichlet, this->Conditions.dirichlet);
  for (std::size_t k = 0; k < Densities.size(); ++k)
  {
    visit(this->densities[k], this->Conditions.*Densities[k].atVertices);
  }
}

void OpenVertices::add(const MeshBlock& block)
{
  // Also of a block without vertices: the problem may keep data of the block for its cells.
  this->ask(block);
  const std::int64_t begin = this->end();
  const std::int64_t end = begin + block.vertices();
  this->forGiven(block,
    [&](auto& ring, const auto& numbers)
    {
      ring.extendRaw(end);
      std::ranges::copy(numbers, ring.at(begin));
    });
  // Zeroed: cells add to these.
  this->mass.extend(end);
  this->scale.extend(end);
  this->ties.extend(end);
  for (std::int64_t vertex = begin; this->ties.any() && vertex < end; ++vertex)
  {
    if (this->ties.isTied(vertex))
    {
      this->ties.require(vertex, this->dirichlet, this->values, this->points.at(vertex));
    }
  }
  if (this->Solved)
  {
    this->readSolution(begin, end);
  }
}

void OpenVertices::readSolution(std::int64_t begin, std::int64_t end)
{
  this->Read.resize(static_cast<std::size_t>((end - begin) * this->Columns));
  this->Solved->read(begin, end - begin, this->Read);
  std::ranges::copy(this->Read, this->values.at(begin));
  if (this->HasRest)
  {
    this->Solved->readRest(begin, end - begin, this->Read);
    this->rest.extendRaw(end);
    std::ranges::copy(this->Read, this->rest.at(begin));
  }
}

double OpenVertices::sumDensities(std::int64_t node, std::span<double> source) const
{
  std::ranges::fill(source, 0.0);
  if (this->ties.isTied(node))
  {
    return 0.0;
  }
  double sum = 0.0;
  this->ties.forVerticesOf(node,
    [&](std::int64_t vertex)
    {
      const double screening = this->densities[ScreeningDensity][vertex] * this->mass[vertex];
      const double* jump = this->ties.jump(vertex);
      for (std::size_t k = 0; k < source.size(); ++k)
      {
        source[k] += this->mass[vertex] * this->densities[SourceDensity].at(vertex)[k];
        source[k] -= jump ? screening * jump[k] : 0.0;
      }
      sum += screening;
    });
  return sum;
}

void OpenVertices::reserve(std::int64_t more)
{
  this->forGiven({}, [more](auto& ring, const auto&) { ring.reserveMore(more); });
  if (this->HasRest)
  {
    this->rest.reserveMore(more);
  }
  this->mass.reserveMore(more);
  this->ties.reserve(more);
  this->scale.reserveMore(more);
}

/** Asks the problem for the conditions at the vertices of a block, and checks them. */
void OpenVertices::ask(const MeshBlock& block)
{
  VertexConditions& given = this->Conditions;
  const auto count = static_cast<std::size_t>(block.vertices());
  const std::size_t values = count * static_cast<std::size_t>(this->Columns);
  const auto sizeOf = [count, this](const Density& density)
  { return count * static_cast<std::size_t>(density.numbers(this->Columns)); };
  given.dirichlet.assign(count, -1);
  given.value.assign(values, 0.0);
  for (const Density& density : Densities)
  {
    (given.*density.atVertices).assign(sizeOf(density), 0.0);
  }
  this->Given.conditions(block, given);
  this->Reserved.resize(this->Given.bytes());
  // A problem may resize the vectors that it fills; the copies in add() would then be out of range.
  const bool keepsSizes = given.dirichlet.size() == count && given.value.size() == values &&
                          std::ranges::all_of(Densities, [&](const Density& density)
                            { return (given.*density.atVertices).size() == sizeOf(density); });
  if (!keepsSizes)
  {
    throw Error("the problem has changed the size of its conditions: a block of " +
                std::to_string(count) + " vertices has one number each, values and sources " +
                std::to_string(this->Columns));
  }

  const auto vertex = [&block](std::ptrdiff_t k)
  {
    return nameOfRow(
      block.vertexColumns, OriginalIdSpec, block.firstVertex, static_cast<std::size_t>(k));
  };
  const auto bad = std::ranges::find_if_not(given.value, [](double v) { return std::isfinite(v); });
  if (bad != given.value.end())
  {
    throw Error("the value of vertex " + vertex((bad - given.value.begin()) / this->Columns) +
                " is not a finite number");
  }
  // Any negative number means that no condition prescribes the value.
  const auto strange = std::ranges::find_if(
    given.dirichlet, [this](std::int32_t number) { return number >= this->DirichletCount; });
  if (strange != given.dirichlet.end())
  {
    throw Error("vertex " + vertex(strange - given.dirichlet.begin()) +
                " names a Dirichlet condition that the problem does not have: see conditionCounts");
  }
  for (const Density& density : Densities)
  {
    const std::vector<double>& numbers = given.*density.atVertices;
    const std::ptrdiff_t invalid = density.findInvalid(numbers.data(), numbers.size());
    if (invalid >= 0)
    {
      throw Error(std::string("the ") + density.name + " of vertex " +
                  vertex(invalid / density.numbers(this->Columns)) + density.complaint());
    }
  }
}

void OpenVertices::release(std::int64_t done, std::int64_t final)
{
  // Rows of neighbours still read these.
  this->points.release(done);
  this->ties.release(done);
  this->values.release(done);
  if (this->HasRest)
  {
    this->rest.release(done);
  }
  this->dirichlet.release(done);
  // Read when the vertex itself is collected, and copied then.
  for (Ring<double>& density : this->densities)
  {
    density.release(final);
  }
  this->mass.release(final);
  this->scale.release(final);
}

} // namespace smg
