// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Deformation/RestShape.h"
#include "Solver/Jobs/Deformation/RotationProblem.h"
#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "Solver/Multigrid/Engine/NextSystem.h"
#include "Solver/Multigrid/Engine/SystemRecords.h"

#include <cstddef>
#include <cstdint>

namespace smg
{

/**
 * The second system of a deformation. The right-hand side of a vertex follows once the rotation and
 * the scale of the vertex and of all its neighbours, the solution of the first system, are final.
 *
 * The unknowns are displacements u = x - p, so that rounding is relative to edges and motions, not
 * to coordinates: b_i = sum_j w_ij ((s_i R_i + s_j R_j) / 2 - I) (p_i - p_j), plus w_ij u_j of each
 * held neighbour j. They start at zero.
 */
class PositionStep final : public NextSystem
{
public:
  /** Columns of the positions. */
  static constexpr int Columns = 3;
  /** A measured lower bound of the memory per vertex in core, including the positions at rest. */
  static constexpr std::int64_t CoreBytes = 140;

  /** `scale`: about the size of its residuals. */
  PositionStep(Pool& pool, RestShape& rest, LevelWindow<double>& window, double scale)
    : Rest(rest)
    , Window(window)
    , Scale(scale)
    , Records(rest.system())
    , Points(pool, 3)
    , Motions(pool, 3)
    , Frames(pool)
  {
  }

  int columns() const override { return Columns; }
  double scale() const override { return this->Scale; }
  void startPass() override;
  void load() override;
  std::int64_t taken() const override { return this->Turned; }
  std::int64_t fill(std::int64_t final) override;
  void endPass() override;

  /** ||b - A x||^2 for the result of the first step. */
  double rotationSquares() const { return this->RotationSquares; }
  /** ||b||^2 of the second step, and the sum of squares of its terms. */
  double initialSquares() const { return this->InitialSquares; }
  double termSquares() const { return this->TermSquares; }

private:
  void turn(std::int64_t end);
  void closeRows(const SystemRecord& record, std::int64_t end);
  template <class Row>
  void closeRow(const SystemRecord& record, std::int64_t i, const Row& row);
  void release();

  RestShape& Rest;
  LevelWindow<double>& Window;
  double Scale;
  OpenRecords Records;
  Ring<double> Points, Motions; // positions at rest; displacements u, set at held vertices only
  Ring<Frame> Frames;
  std::int64_t Turned = 0, Done = 0, Unneeded = 0;
  std::size_t NextLink = 0; // in the record of Done
  double RotationSquares = 0.0, InitialSquares = 0.0, TermSquares = 0.0;
};

} // namespace smg
