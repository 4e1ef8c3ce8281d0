// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Deformation/RestShape.h"
#include "Solver/Jobs/Deformation/RotationProblem.h"
#include "Solver/Multigrid/Cycle/LevelWindow.h"

#include <cstdint>
#include <deque>

namespace smg
{

/**
 * The start of the second step of a deformation, a stage between the upward part of the last
 * V-cycle of the first step and the downward part of the first V-cycle of the second step. It
 * computes the right-hand side of a vertex once the rotation and the scale of the vertex and of all
 * its neighbours are final.
 *
 * The unknowns are displacements u = x - p, so that rounding is relative to edges and motions, not
 * to coordinates: b_i = sum_j w_ij ((s_i R_i + s_j R_j) / 2 - I) (p_i - p_j), plus w_ij u_j of each
 * held neighbour j. They start at zero.
 */
class PositionStep
{
public:
  /** Columns of the positions. */
  static constexpr int Columns = 3;
  /** A measured lower bound of the memory per vertex in core, including the positions at rest. */
  static constexpr std::int64_t CoreBytes = 140;

  /** Reads the state of the upward part of the window and fills that of its downward part. */
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

  /** Loads the same vertices as the window. */
  void load();
  /** Computes right-hand sides as far as possible, given that the upward part of the rotations has
   * finished all vertices below `final`. */
  void advance(std::int64_t final);
  /** The number of vertices whose rotation and scale are known to be final. */
  std::int64_t turned() const { return this->Turned; }
  /** The number of vertices with a right-hand side. */
  std::int64_t done() const { return this->Done; }

  /** ||b - A x||^2 for the result of the first step. */
  double rotationSquares() const { return this->RotationSquares; }
  /** ||b||^2 of the second step, and the sum of squares of its terms. */
  double initialSquares() const { return this->InitialSquares; }
  double termSquares() const { return this->TermSquares; }

private:
  void turn(std::int64_t end);
  void closeGroup(const RestBlock& block, std::int64_t end);
  template <class Row>
  void closeRow(const RestBlock& block, std::int64_t i, const Row& row);
  void release();

  RestShape& Rest;
  LevelWindow<double>& Window;
  std::deque<RestBlock> Blocks;
  Ring<double> Points, Motions; // positions at rest; displacements u, set at held vertices only
  Ring<Frame> Frames;
  std::int64_t Turned = 0, Done = 0;
  std::size_t NextLink = 0; // in the block of Done
  double RotationSquares = 0.0, InitialSquares = 0.0, TermSquares = 0.0;
};

} // namespace smg
