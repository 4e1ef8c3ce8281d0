// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/CheckShared.h"

#include "Solver/Distributed/PartNames.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <sstream>
#include <string>

namespace smg
{
namespace
{

/** What may differ, of the largest number: arrays in single precision that are sums over cells, in
 * another order on each process. */
constexpr double Rounding = 1e-6;

/** Throws Error if `what` differs: take(vertex, numbers) sets the `lanes` numbers of a vertex. */
template <class Take>
void checkSame(const SharedVertices& vertices, const MeshPart& part, const std::string& what,
  int lanes, Take&& take)
{
  const std::int64_t v = vertices.findDifferent(lanes, Rounding, take);
  if (v < 0)
  {
    return;
  }
  const double* p = part.block.positions.data() + 3 * v;
  std::ostringstream place;
  place << '(' << p[0] << ", " << p[1] << ", " << p[2] << ')';
  throw Error(what + " of vertex " + nameOfVertex(part, v) + " at " + place.str() +
              " differs between process " + std::to_string(vertices.team().rank()) +
              " and process " + std::to_string(vertices.ownerOf(vertices.id(v))) +
              ": arrays that are made piece by piece, e.g. by Cell Data to Point Data, need ghost "
              "cells; positions and arrays must be the same wherever a vertex is");
}

void set(std::span<double> numbers, const double* values)
{
  std::copy_n(values, numbers.size(), numbers.begin());
}

} // namespace

void checkSharedPositions(const SharedVertices& vertices, const MeshPart& part)
{
  checkSame(vertices, part, "the position", 3,
    [&part](std::int64_t v, std::span<double> numbers)
    { set(numbers, part.block.positions.data() + 3 * v); });
}

void checkSharedConditions(
  const SharedVertices& vertices, const MeshPart& part, const OpenVertices& given)
{
  const auto isKnown = [&given](std::int64_t v) { return given.dirichlet[v] >= 0; };
  checkSame(vertices, part, "whether the problem prescribes the value", 1,
    [&](std::int64_t v, std::span<double> numbers) { numbers[0] = isKnown(v) ? 1.0 : 0.0; });
  // Initial values are those of the owner.
  checkSame(vertices, part, "the prescribed value", given.values.lanes(),
    [&](std::int64_t v, std::span<double> numbers)
    {
      std::ranges::fill(numbers, 0.0);
      if (isKnown(v))
      {
        set(numbers, given.values.at(v));
      }
    });
  checkSame(vertices, part, "the source", given.sources.lanes(),
    [&](std::int64_t v, std::span<double> numbers) { set(numbers, given.sources.at(v)); });
  checkSame(vertices, part, "the screening", 1,
    [&](std::int64_t v, std::span<double> numbers) { set(numbers, given.screening.at(v)); });
}

void checkSharedTargets(
  const SharedVertices& vertices, const MeshPart& part, const VertexHandles& handles)
{
  checkSame(vertices, part, "the target that a handle gives", 3,
    [&](std::int64_t v, std::span<double> numbers)
    {
      std::ranges::fill(numbers, 0.0);
      if (handles.mask[static_cast<std::size_t>(v)] > 0)
      {
        set(numbers, handles.target.data() + 3 * v);
      }
    });
}

} // namespace smg
