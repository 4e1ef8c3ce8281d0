// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
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
 * Large is meant beside the usual diagonal of the rows so far, their geometric mean, so that neither
 * a conductivity's size nor the length unit matters.
 *
 * As many rows are stiff as the direct solve of the coarsest level bears, where most of them may
 * end: of a level of slivers only, the first ones.
 */
class StiffRows
{
public:
  /** No row is stiff. */
  StiffRows() = default;
  /**
   * For the stiffness of triangles, where a usual diagonal is 4: half the cotangent of 166 degrees,
   * in one triangle or the sum of two, is large. From -1 to -3 dragon.ply converged as fast, at -8 it
   * did not. On tetrahedra, most of which have negative weights, it did not pay.
   */
  static StiffRows ofTriangles() { return StiffRows(0.5); }

  /** Whether any row may be. */
  bool any() const { return this->Share > 0.0; }

  /** Whether the next row is, whose smallest weight is `least`. */
  bool operator()(float least, double diagonal)
  {
    if (!this->any())
    {
      return false;
    }
    ++this->Rows;
    if (diagonal < Most)
    {
      this->Logarithms += std::log2(diagonal);
      ++this->Usual;
    }
    if (!(least < 0.0F) || this->Found >= MostAtFirst + this->Rows / MostShare)
    {
      return false;
    }
    const double usual = std::exp2(this->Logarithms / static_cast<double>(this->Usual));
    const bool stiff = static_cast<double>(least) < -this->Share * usual;
    this->Found += stiff ? 1 : 0;
    return stiff;
  }

private:
  static constexpr std::int64_t MostAtFirst = 4096, MostShare = 128;
  /** Above are the diagonals of rows without edges (see usableDiagonal). */
  static constexpr double Most = 1e20;

  explicit StiffRows(double share)
    : Share(share)
  {
  }

  double Share = 0.0, Logarithms = 0.0;
  std::int64_t Rows = 0, Usual = 0, Found = 0;
};

} // namespace smg
