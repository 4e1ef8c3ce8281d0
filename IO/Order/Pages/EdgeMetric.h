// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/** A sample of the cells of a mesh, distributed over its file, with the coordinates of their
 * corners. */
struct CellSample
{
  /** The maximum number of cells of a sample. */
  static constexpr std::int64_t Most = 8192;

  std::size_t corners = 3;                      ///< of a cell
  std::vector<std::uint32_t> vertices;          ///< `corners` per cell
  std::vector<std::array<double, 3>> positions; ///< of each of them

  std::size_t cells() const { return this->vertices.size() / this->corners; }

  /** Places in `vertices` of a sample of the vertices of the mesh: one corner of each cell, so that
   * a vertex of many cells does not dominate, and each vertex once. */
  std::vector<std::size_t> differentVertices() const;
};

/** Selects a random cell from each of CellSample::Most parts of the file. */
CellSample sampleCells(const RawMesh& mesh);

/** A Hilbert curve through a cube of 2^21 cells per side, by tables of two levels at a time. */
class HilbertCurve
{
public:
  /** The bits of a coordinate. A key has three times as many. */
  static constexpr int Bits = 21;
  static constexpr std::uint32_t Largest = (std::uint32_t(1) << Bits) - 1;

  HilbertCurve();

  /** The number of cells before the one at these coordinates, each at most Largest. */
  std::uint64_t key(std::uint32_t x, std::uint32_t y, std::uint32_t z) const
  {
    // The 22nd bits are zero, and so is their share of the key: it ends as 63 bits.
    std::uint64_t key = 0;
    std::uint32_t state = 0;
    for (int bit = Bits - 1; bit >= 0; bit -= 2)
    {
      const std::uint32_t place = (x >> bit & 3) | (y >> bit & 3) << 2 | (z >> bit & 3) << 4;
      const std::uint32_t step = this->Steps[state | place];
      key = key << 6 | (step & 63);
      state = step & ~63u;
    }
    return key;
  }

private:
  static constexpr int States = 24;
  /** By state * 64 + position: the next state * 64 + the next six bits of the key. */
  std::array<std::uint16_t, States * 64> Steps;
};

/**
 * Positions of vertices along a Hilbert curve, in coordinates in which the edges of a mesh are
 * about equally long in all directions, so that thin triangles, layers or a few distant points do
 * not separate neighbours.
 */
class EdgeMetric
{
public:
  /** From the edges and the extent of a sample with any finite coordinates. */
  explicit EdgeMetric(const CellSample& sample);

  template <class Real>
  std::uint64_t key(const Real* position) const
  {
    const double x = position[0], y = position[1], z = position[2];
    return this->Curve.key(
      this->coordinate(0, x, y, z), this->coordinate(1, x, y, z), this->coordinate(2, x, y, z));
  }

private:
  struct Axis
  {
    std::array<double, 3> direction{}; ///< its length is the scale
    double low = 0;
  };

  std::uint32_t coordinate(int k, double x, double y, double z) const
  {
    const Axis& axis = this->Axes[std::size_t(k)];
    const double value =
      axis.direction[0] * x + axis.direction[1] * y + axis.direction[2] * z - axis.low;
    // Written such that NaN becomes 0.
    return value > 0 ? (value < HilbertCurve::Largest ? static_cast<std::uint32_t>(value)
                                                      : HilbertCurve::Largest)
                     : 0;
  }

  HilbertCurve Curve;
  std::array<Axis, 3> Axes;
};

/** Whether the numbers of the vertices represent neighbourhood clearly better than the positions
 * along the curve: for more of the sampled edges, the two ends are within `tolerance` of each
 * other, of `vertices` numbers or ranks. */
bool numbersAreMoreLocal(
  const CellSample& sample, const EdgeMetric& metric, std::int64_t vertices, double tolerance);

} // namespace smg
