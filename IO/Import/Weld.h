// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"
#include "IO/Import/VertexFilter.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace smg
{

/** A point with its number. */
struct WeldPoint
{
  std::array<double, 3> position;
  std::uint32_t id;

  bool operator<(const WeldPoint& other) const
  {
    return this->position != other.position ? this->position < other.position : this->id < other.id;
  }
};

/** Throws Error unless weldPoints() accepts this tolerance. */
void checkWeldDistance(double tolerance);

/**
 * Merges points at the same position: cells then name the first one of them, and the others have no
 * cells. Points are processed in ascending order of x (then y, z, number); each is merged with the
 * first remaining earlier one within `tolerance` of it, if there is one.
 * @param tolerance largest distance, in units of the coordinates, at least 0: equal coordinates
 * @param joined if not null, gets the points with which others were merged
 * @return the number of merged points
 * @throws Error if the tolerance is negative or not a number, or if more points lie within the
 * tolerance along x than fit into the memory; Cancelled
 */
std::int64_t weldPoints(
  RawMesh& mesh, double tolerance, Workspace& workspace, VertexFilter* joined = nullptr);

/** The points with which weldPoints() merges those of a mesh in memory, themselves where it does
 * not: by their numbers, which are 0, 1, ... in any order. `memory`: bytes for points that may be
 * near later ones, as of Workspace; `poll` may throw, to cancel. */
std::vector<std::uint32_t> mergedWith(std::vector<WeldPoint> points, double tolerance,
  std::int64_t memory, const std::function<void()>& poll);

} // namespace smg
