// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/CheckPart.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <sstream>
#include <string>

// Checks of the parts of a mesh: that each is valid, and that processes agree on the vertices that
// they share. The first are local; the second compare each shared vertex with its owner, one
// exchange for each kind of data.

namespace smg
{

void checkPart(const MeshPart& part)
{
  const MeshBlock& block = part.block;
  const auto vertices = static_cast<std::int64_t>(part.ids.size());
  const auto corners = static_cast<std::size_t>(cornersOf(part.info.cellType));
  // Sizes first: what follows uses them as bounds.
  if (block.positions.size() != 3 * part.ids.size() || block.corners.size() % corners != 0 ||
      block.firstVertex != 0 || block.finalized != 0)
  {
    throw Error("a part of the mesh is not valid: it has the stream indices of " +
                std::to_string(vertices) + " vertices and " +
                std::to_string(block.positions.size()) + " coordinates");
  }
  const auto infinite = std::ranges::find_if_not(
    block.positions, [](double coordinate) { return std::isfinite(coordinate); });
  if (infinite != block.positions.end())
  {
    const auto place = static_cast<std::size_t>((infinite - block.positions.begin()) / 3);
    throw Error(
      "the position of vertex " + std::to_string(part.ids[place]) + " is not a finite number");
  }
  // Corners are places in the part. A corner outside of it would be read beyond the arrays.
  const auto outside = std::ranges::find_if(
    block.corners, [vertices](std::int64_t v) { return v < 0 || v >= vertices; });
  if (outside != block.corners.end())
  {
    const std::int64_t cell =
      block.firstCell + (outside - block.corners.begin()) / static_cast<std::int64_t>(corners);
    throw Error("a part of the mesh is not valid: cell " + std::to_string(cell) +
                " uses a vertex that the part does not have");
  }
}

namespace
{

/** The share of the largest number by which shared data may differ: arrays in single precision that
 * are sums over cells, which each process adds up in another order. */
constexpr double Rounding = 1e-6;

/** Throws Error if `what` differs at a shared vertex, given take(vertex, numbers), which sets the
 * `lanes` numbers of a vertex. The message names the first such vertex of this process and both
 * processes. */
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

/** Copies as many values as there are numbers. */
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
  // First whether a value is prescribed, then the value: a vertex that one process prescribes and
  // another one computes would make the matrix unsymmetric.
  const auto isKnown = [&given](std::int64_t v) { return given.dirichlet[v] >= 0; };
  checkSame(vertices, part, "whether the problem prescribes the value", 1,
    [&](std::int64_t v, std::span<double> numbers) { numbers[0] = isKnown(v) ? 1.0 : 0.0; });
  // Where nothing is prescribed `values` has initial values, which may differ: the owner's count.
  checkSame(vertices, part, "the prescribed value", given.values.lanes(),
    [&](std::int64_t v, std::span<double> numbers)
    {
      std::ranges::fill(numbers, 0.0);
      if (isKnown(v))
      {
        set(numbers, given.values.at(v));
      }
    });
  for (std::size_t k = 0; k < Densities.size(); ++k)
  {
    const Ring<double>& density = given.densities[k];
    checkSame(vertices, part, std::string("the ") + Densities[k].name, density.lanes(),
      [&](std::int64_t v, std::span<double> numbers) { set(numbers, density.at(v)); });
  }
}

void checkSharedTargets(
  const SharedVertices& vertices, const MeshPart& part, const VertexHandles& handles)
{
  checkSame(vertices, part, "the target that a handle gives", 3,
    [&](std::int64_t v, std::span<double> numbers)
    {
      // What is not held has no target, and compares as equal.
      std::ranges::fill(numbers, 0.0);
      if (handles.mask[static_cast<std::size_t>(v)] > 0)
      {
        set(numbers, handles.target.data() + 3 * v);
      }
    });
}

} // namespace smg
