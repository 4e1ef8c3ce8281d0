// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Streaming/vtkStreamedTask.h"
#include "Solver/Description/ProblemDescription.h"

#include <string>

namespace smg
{

/** The point arrays that make a Poisson problem; an empty name: there is none. */
struct PoissonArrays
{
  std::string mask;   ///< not 0: the point is constrained
  std::string values; ///< the prescribed values
  std::string source; ///< source densities
  std::string guess;  ///< initial values of the free points; without it, 0
};

/** A Poisson problem in the arrays of the pieces. The number of components of values, source and
 * guess, which must agree, is the number of right-hand sides. */
class PoissonTask : public StreamedTask
{
public:
  PoissonArrays arrays;
  Weights weights = Weights::Cotangent;
  double screening = 0.0;
  SolveOptions options; ///< but for the progress

  void check() const override;
  PieceColumns columns() const override;
  std::unique_ptr<Solution> solve(
    const VsmReader& mesh, const ProgressFunction& progress) const override;

private:
  ProblemDescription describe(const StreamInfo& mesh) const;
};

} // namespace smg
