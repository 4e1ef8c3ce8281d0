// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/LevelWindow.h"
#include "Solver/Deformation/Frame.h"
#include "Solver/Deformation/RestShape.h"

#include <cstdint>
#include <deque>

namespace smg
{

/**
 * The beginning of the second step of a deformation, a stage between the way up of the first step's
 * last V-cycle and the way down of the second step's first one: when the rotation and the scale of
 * a vertex and of all its neighbours are final, its right-hand side.
 *
 * The unknowns are displacements u = x - p, so that rounding is that of edges and motions, not of
 * coordinates: b_i = sum_j w_ij ((s_i R_i + s_j R_j) / 2 - I) (p_i - p_j), plus w_ij u_j of each
 * held neighbour j. They start at zero.
 */
class PositionStep
{
public:
  /** Of the positions. */
  static constexpr int Columns = 3;
  /** What a vertex needs in core at least, with its positions at rest; measured, from below. */
  static constexpr std::int64_t CoreBytes = 140;

  /** Reads the state of the window's way up and fills that of its way down. */
  PositionStep(Pool& pool, RestShape& rest, LevelWindow<double>& window)
    : Rest(rest)
    , Window(window)
    , Points(pool, 3)
    , Motions(pool, 3)
    , Frames(pool)
  {
  }

  void startPass() { this->Rest.startPass(); }
  void endPass() { this->Rest.endPass(); }

  /** Follows the window, which has been loaded. */
  void load();
  /** Makes right-hand sides, given that the way up is done below `final`. */
  void advance(std::int64_t final);
  /** Vertices whose right-hand side is there. */
  std::int64_t done() const { return this->Done; }

  /** ||b - A x||^2 of the first step's result. */
  double rotationSquares() const { return this->RotationSquares; }
  /** ||b||^2 of the second step, and the same of the terms that it is the sum of. */
  double initialSquares() const { return this->InitialSquares; }
  double termSquares() const { return this->TermSquares; }

private:
  void turn(std::int64_t end);
  void closeGroup(const RestBlock& block, std::int64_t end);
  template <class Arrays>
  void closeRow(const RestBlock& block, const RowBlock::Header& h, const Arrays& a, std::int64_t k);
  void release();

  RestShape& Rest;
  LevelWindow<double>& Window;
  std::deque<RestBlock> Blocks;
  Ring<double> Points, Motions; // Motions: u of held vertices
  Ring<Frame> Frames;
  std::int64_t Turned = 0, Done = 0;
  std::size_t NextLink = 0; // in the block of Done
  double RotationSquares = 0.0, InitialSquares = 0.0, TermSquares = 0.0;
};

} // namespace smg
