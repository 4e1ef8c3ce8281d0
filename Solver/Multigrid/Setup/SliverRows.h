// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace smg
{

/**
 * Finds the stiff rows of a level: those with a large negative weight. A sliver of three nearly
 * collinear vertices has weights w on its short edges and -w/2 on the long one: together they
 * resist only bending, so functions that are linear along a chain of slivers have nearly no energy.
 * Such an error is slow; interpolation with few entries cannot represent it, and small changes of
 * the weights destroy it. So a stiff node has its own coarse node, no entry of its row is removed,
 * and the weights of coarse levels are floats.
 *
 * The number of stiff rows is limited by the direct solve of the coarsest level, where most of them
 * may end: on a level of slivers only, the first rows are stiff.
 */
class SliverRows
{
public:
  /**
   * For the stiffness of triangles, which has no unit: half the cotangent of 166 degrees, in one
   * triangle or the sum of two. From -1 to -3 dragon.ply converges equally fast, at -8 it does not.
   * On tetrahedra, most of which have negative weights, it does not pay off.
   */
  static constexpr double Triangles = -2.0;

  /** No row is stiff. */
  SliverRows() = default;
  /** Rows with a weight below `below` times `scale` are stiff; `scale`, the size of the
   * conductivity, is set when the first row arrives. */
  explicit SliverRows(double below, const double& scale)
    : Below(below)
    , Scale(&scale)
  {
  }

  SliverRows(double below, const double&& scale) = delete; // it would be gone

  /** Whether any row may be stiff. */
  bool any() const { return this->Scale != nullptr; }

  /** Whether the next row is stiff, whose smallest weight is `least`. */
  bool operator()(float least)
  {
    if (!this->any())
    {
      return false;
    }
    ++this->Rows;
    const bool stiff = static_cast<double>(least) < this->Below * *this->Scale &&
                       this->Found < MaxAtFirst + this->Rows / MaxShare;
    this->Found += stiff ? 1 : 0;
    return stiff;
  }

  /** The number of stiff rows so far. */
  std::int64_t found() const { return this->Found; }

private:
  static constexpr std::int64_t MaxAtFirst = 4096, MaxShare = 128;

  double Below = 0.0;
  const double* Scale = nullptr;
  std::int64_t Rows = 0, Found = 0;
};

} // namespace smg
