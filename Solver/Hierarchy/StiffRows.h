// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace smg
{

/**
 * Finds the rows of a level that are stiff: those with a large negative weight. A sliver of three
 * nearly collinear vertices has weights w on its short edges and -w/2 on the long one: together
 * they resist bending alone, so what is linear along a chain of slivers costs next to nothing. That
 * is a slow error, which interpolation with few entries cannot express and which small changes
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
   * For the stiffness of triangles, which has no unit: half the cotangent of 166 degrees, in one
   * triangle or the sum of two. From -1 to -3 dragon.ply converged as fast, at -8 it did not. On
   * tetrahedra, most of which have negative weights, it did not pay.
   */
  static constexpr double Triangles = -2.0;

  /** No row is stiff. */
  StiffRows() = default;
  /** Rows with a weight below `below` times `scale` are, which has its value when the first row
   * comes: the size of the conductivity. */
  explicit StiffRows(double below, const double& scale)
    : Below(below)
    , Scale(&scale)
  {
  }

  /** Whether any row may be. */
  bool any() const { return this->Scale != nullptr; }

  /** Whether the next row is, whose smallest weight is `least`. */
  bool operator()(float least)
  {
    if (!this->any())
    {
      return false;
    }
    ++this->Rows;
    const bool stiff = static_cast<double>(least) < this->Below * *this->Scale &&
                       this->Found < MostAtFirst + this->Rows / MostShare;
    this->Found += stiff ? 1 : 0;
    return stiff;
  }

  /** How many were. */
  std::int64_t found() const { return this->Found; }

private:
  static constexpr std::int64_t MostAtFirst = 4096, MostShare = 128;

  double Below = 0.0;
  const double* Scale = nullptr;
  std::int64_t Rows = 0, Found = 0;
};

} // namespace smg
