// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

namespace smg
{

/**
 * Finds the rows of a level that are stiff: those with a large negative weight. A sliver of three
 * nearly collinear vertices has weights w on its short edges and -w/2 on the long one: together
 * they resist bending alone, so what is linear along a chain of slivers costs next to nothing. That
 * is a slow error, which interpolation with positive entries cannot express and which small changes
 * of the weights destroy. So a stiff node has a coarse node of its own, no entry of its row is
 * removed, and the weights of coarse levels are floats.
 *
 * As many rows are stiff as the direct solve of the coarsest level bears, where most of them may
 * end: of a level of slivers only, the first ones.
 */
class StiffRows
{
public:
  /**
   * For the cotangents of triangles, which have no unit: half the cotangent of 166 degrees, in one
   * triangle or the sum of two. From -1 to -3 dragon.ply converged as fast, at -8 it did not. On
   * tetrahedra, most of which have negative weights, it did not pay.
   */
  static constexpr float Triangles = -2.0F;

  /** No row is stiff. */
  StiffRows() = default;
  /** Rows with a weight below `below` are. */
  explicit StiffRows(float below)
    : Below(below)
  {
  }

  /** Whether any row may be. */
  bool any() const { return this->Below > Never; }

  /** Whether the next row is, whose smallest weight is `least`. */
  bool operator()(float least)
  {
    ++this->Rows;
    const bool stiff = least < this->Below && this->Found < MostAtFirst + this->Rows / MostShare;
    this->Found += stiff ? 1 : 0;
    return stiff;
  }

private:
  static constexpr float Never = -std::numeric_limits<float>::infinity();
  static constexpr std::int64_t MostAtFirst = 4096, MostShare = 128;

  float Below = Never;
  std::int64_t Rows = 0, Found = 0;
};

} // namespace smg
