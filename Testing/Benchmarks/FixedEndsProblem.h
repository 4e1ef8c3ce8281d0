// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Problem.h"

namespace smg::benchmark
{

/**
 * The measured problem: three columns, cotangent weights; vertices within 2 % of the mesh's height
 * from its lowest or highest z keep their positions.
 */
class FixedEndsProblem : public Problem
{
public:
  /** The initial values of the other vertices. */
  enum class Start
  {
    Zero,
    Positions
  };

  explicit FixedEndsProblem(const StreamInfo& info, Start start = Start::Positions);

  int columns() const override { return 3; }
  int vectorSize() const override { return 3; }
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;

private:
  double Low;
  double High;
  Start From;
};

} // namespace smg::benchmark
