// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/ColumnScales.h"
#include "Solver/Multigrid/Engine/CompiledOperators.h"
#include "smg/Problem.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

class PoissonSolver;

/** How far a solve has come: norms over the rows of the finest level. */
struct SolveNorms
{
  double initial = 0.0;  ///< of the residual that the tolerance is a share of
  double residual = 0.0; ///< of the last residual
  double rounding = 0.0; ///< of the rounding of the terms of that
  double flow = 0.0;     ///< of what flows: see IterateFlow; 0: not measured
  ColumnScales scales;   ///< of the columns in all of these
};

/** The relative residual of a correction that a solve to this tolerance is likely to need, if
 * conductivities differ by this factor; 1: none. */
double correctionTolerance(double contrast, double tolerance);

/** A solution without the correction that it needs, since that failed: a warning says why. */
class UncorrectedSolution final : public Solution
{
public:
  UncorrectedSolution(std::unique_ptr<Solution> solution, const std::string& reason);

  std::int64_t vertices() const override { return this->First->vertices(); }
  int columns() const override { return this->First->columns(); }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    this->First->read(first, count, values);
  }
  bool hasRest() const override { return this->First->hasRest(); }
  void readRest(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    this->First->readRest(first, count, values);
  }
  void removeCheckpoint() override { this->First->removeCheckpoint(); }
  const Report& report() const override { return this->Reported; }

private:
  std::unique_ptr<Solution> First;
  Report Reported;
};

/** A solution and its correction. Their sum has the digits of both, of which a double has the
 * first: see Solution::readRest(). */
class CorrectedSolution final : public Solution
{
public:
  /** `ofCorrection`, `ofSolution`: the residuals that those of the report of each are relative to.
   */
  CorrectedSolution(std::unique_ptr<Solution> solution, std::unique_ptr<Solution> correction,
    double ofCorrection, double ofSolution);

  std::int64_t vertices() const override { return this->First->vertices(); }
  int columns() const override { return this->First->columns(); }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override;
  bool hasRest() const override { return true; }
  void readRest(std::int64_t first, std::int64_t count, std::span<double> values) override;
  void removeCheckpoint() override { this->First->removeCheckpoint(); }
  const Report& report() const override { return this->Reported; }

private:
  void add(std::int64_t first, std::int64_t count, std::size_t numbers);

  std::unique_ptr<Solution> First, Correction;
  Report Reported;
  std::vector<double> Sum, Rest, Added; // of the vertices from Begin on, which were read last
  std::int64_t Begin = -1;
};

/**
 * Solves for corrections of a solution until its residual is small beside what flows, which the
 * rounding of its values to doubles may not permit: iterative refinement, with the residual summed
 * up in differences of the values (Assembly). As a rule one suffices for coefficients that differ
 * by up to 1e15. A correction that fails, for want of memory, of room for scratch files or of
 * V-cycles, leaves the solution as it is. `solver` has solved for the solution.
 */
std::unique_ptr<Solution> corrected(const CompiledOperators& operators, Problem& problem,
  const SolveOptions& options, std::unique_ptr<Solution> solution, const PoissonSolver& solver);

} // namespace smg
