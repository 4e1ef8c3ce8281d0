// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace smg
{

/** Finds the degenerate and the duplicate cells of a mesh stream, block by block. Only the vertices
 * that are not final, and the cells between them, are in memory. */
class CellFlagger
{
public:
  explicit CellFlagger(CellType cellType)
    : Corners(static_cast<std::size_t>(cornersOf(cellType)))
  {
  }

  /** The CellFlag bits of the cells of the stream's next block. */
  const std::vector<std::uint8_t>& flags(const MeshBlock& block);

  std::int64_t degenerateCells() const { return this->Degenerate; }
  std::int64_t duplicateCells() const { return this->Duplicates; }

  /** Bytes of a vertex of the window with its cells. */
  static constexpr std::int64_t BytesPerVertex = 256;

private:
  /** The cells of a vertex; each is listed under one of its corners. */
  using CellsOfVertex = std::vector<std::array<std::int64_t, 4>>;

  std::uint8_t flag(const std::int64_t* corners);

  std::size_t Corners;
  std::int64_t First = 0; ///< stream index of the first vertex of the window
  std::deque<std::array<double, 3>> Points;
  std::deque<CellsOfVertex> Cells;
  std::vector<std::uint8_t> Flags;
  std::int64_t Degenerate = 0;
  std::int64_t Duplicates = 0;
};

/**
 * Whether a triangle or tetrahedron is degenerate: a corner is repeated, or its area or volume is
 * zero up to rounding (1e-14 of what its longest edge allows).
 * @param corners 3 or 4 indices
 * @param points the coordinates of these corners
 */
bool isDegenerate(
  std::span<const std::int64_t> corners, std::span<const std::array<double, 3>> points);

/** Six times the volume of a tetrahedron; negative if its corners are in the other order. */
double orientedVolume(const std::array<std::array<double, 3>, 4>& points);

} // namespace smg
