// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace smg
{

/**
 * Finds the stiff rows of a level: those with a large negative weight. A sliver of three nearly
 * collinear vertices has weights w on its short edges and -w/2 on the long one. Together they
 * resist only bending, so functions that are linear along a chain of slivers have almost no energy.
 * Relaxation reduces such an error slowly, interpolation with few entries cannot represent it, and
 * small changes of the weights destroy it. A stiff node therefore has a coarse node of its own, no
 * entry of its row is removed, and where rows may be stiff the weights of coarse levels are floats,
 * not BFloat16.
 *
 * The number of stiff rows is limited, for the sake of the direct solve on the coarsest level,
 * where most of them may end: on a level that consists of slivers, only the first rows count as
 * stiff.
 */
class SliverRows
{
public:
  /**
   * For the stiffness of triangles, which has no unit: half the cotangent of 166 degrees, in one
   * triangle or as the sum of two. With limits from -1 to -3 dragon.ply converges equally fast,
   * with -8 it does not. On tetrahedra, most of which have negative weights, stiff rows do not pay
   * off.
   */
  static constexpr double Triangles = -2.0;

  /** No row is stiff. */
  SliverRows() = default;
  /** Rows with a weight below `below` times `scale` are stiff. `scale`, the size of the
   * conductivity, is set when the first row arrives, hence the reference. */
  explicit SliverRows(double below, const double& scale)
    : Below(below)
    , Scale(&scale)
  {
  }

  SliverRows(double below, const double&& scale) = delete; // a temporary would be gone

  /** Whether any row may be stiff. */
  bool any() const { return this->Scale != nullptr; }

  /** Whether the next row, whose smallest weight is `least`, is stiff. To be called once per
   * row, in node order, since it counts the rows. */
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
  /** At most 4096 stiff rows, and one more for each 128 rows. */
  static constexpr std::int64_t MaxAtFirst = 4096, MaxShare = 128;

  double Below = 0.0;
  const double* Scale = nullptr;
  std::int64_t Rows = 0, Found = 0;
};

} // namespace smg
