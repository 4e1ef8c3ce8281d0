// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/OpenVertices.h"

#include "Solver/Mesh/AddedColumn.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

// The data of open vertices: what the stream and the problem give for each vertex, once and in
// stream order, and what its cells sum up to. All numbers of a problem are checked here, where the
// vertex can still be named: one NaN would make the whole solution NaN.

namespace smg
{

OpenVertices::OpenVertices(Pool& pool, Problem& problem)
  : points(pool, 3)
  , values(pool, problem.columns())
  , dirichlet(pool)
  , sources(pool, problem.columns())
  , screening(pool)
  , mass(pool)
  , scale(pool)
  , Given(problem)
  , Kept(pool)
  , Columns(problem.columns())
  , DirichletCount(problem.conditionCounts().dirichlet)
{
}

void OpenVertices::add(const MeshBlock& block)
{
  // Also of a block without vertices: the problem may keep data of the block for its cells.
  this->ask(block);
  const std::int64_t begin = this->end();
  const std::int64_t end = begin + block.vertices();
  this->points.extendRaw(end);
  this->values.extendRaw(end);
  this->dirichlet.extendRaw(end);
  this->sources.extendRaw(end);
  this->screening.extendRaw(end);
  // Zeroed: cells add to these.
  this->mass.extend(end);
  this->scale.extend(end);
  const VertexConditions& given = this->Conditions;
  std::copy(block.positions.begin(), block.positions.end(), this->points.at(begin));
  std::copy(given.value.begin(), given.value.end(), this->values.at(begin));
  std::copy(given.dirichlet.begin(), given.dirichlet.end(), this->dirichlet.at(begin));
  std::copy(given.source.begin(), given.source.end(), this->sources.at(begin));
  std::copy(given.screening.begin(), given.screening.end(), this->screening.at(begin));
}

void OpenVertices::reserve(std::int64_t more)
{
  this->points.reserveMore(more);
  this->values.reserveMore(more);
  this->dirichlet.reserveMore(more);
  this->sources.reserveMore(more);
  this->screening.reserveMore(more);
  this->mass.reserveMore(more);
  this->scale.reserveMore(more);
}

/** Asks the problem for the conditions at the vertices of a block, and checks them. */
void OpenVertices::ask(const MeshBlock& block)
{
  VertexConditions& given = this->Conditions;
  const auto count = static_cast<std::size_t>(block.vertices());
  const std::size_t values = count * static_cast<std::size_t>(this->Columns);
  given.dirichlet.assign(count, -1);
  given.value.assign(values, 0.0);
  given.source.assign(values, 0.0);
  given.screening.assign(count, 0.0);
  this->Given.conditions(block, given);
  this->Kept.resize(this->Given.bytes());
  // A problem may resize the vectors that it fills; the copies in add() would then be out of range.
  if (given.dirichlet.size() != count || given.value.size() != values ||
      given.source.size() != values || given.screening.size() != count)
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
  for (const auto* numbers : { &given.value, &given.source })
  {
    const auto bad = std::ranges::find_if_not(*numbers, [](double v) { return std::isfinite(v); });
    if (bad != numbers->end())
    {
      throw Error("the value or source of vertex " +
                  vertex((bad - numbers->begin()) / this->Columns) + " is not a finite number");
    }
  }
  // Any negative number means that no condition prescribes the value.
  const auto strange = std::ranges::find_if(
    given.dirichlet, [this](std::int32_t number) { return number >= this->DirichletCount; });
  if (strange != given.dirichlet.end())
  {
    throw Error("vertex " + vertex(strange - given.dirichlet.begin()) +
                " names a Dirichlet condition that the problem does not have: see conditionCounts");
  }
  const auto negative = std::ranges::find_if_not(
    given.screening, [](double s) { return s >= 0.0 && std::isfinite(s); });
  if (negative != given.screening.end())
  {
    throw Error("the screening of vertex " + vertex(negative - given.screening.begin()) +
                " must be a finite number that is not negative");
  }
}

void OpenVertices::release(std::int64_t done, std::int64_t final)
{
  // Rows of neighbours still read these.
  this->points.release(done);
  this->values.release(done);
  this->dirichlet.release(done);
  // Read when the vertex itself is collected, and copied then.
  this->sources.release(final);
  this->screening.release(final);
  this->mass.release(final);
  this->scale.release(final);
}

} // namespace smg
