// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Results/DiscretisationError.h"
#include "smg/Export.h"
#include "smg/Report.h"

#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace smg
{

/**
 * Stops V-cycles when more of them would not bring the result nearer to the solution of the
 * continuous problem: when the algebraic error is below a tenth of the discretisation error, both
 * in the energy norm.
 *
 * The squared algebraic error falls in V-cycle k by f_k = 2 (J_{k-1} - J_k), see IterateEnergy
 * (Hestenes and Stiefel 1952; Meurant and Tichy 2013). If each further V-cycle multiplies it by q,
 * the error that is left is f_k q / (1 - q). For q the largest of f_k / f_{k-1} and the squared
 * factors of the last two residuals is taken.
 *
 * The discretisation error is estimated with the present iterate, in an additional pass over the
 * mesh that costs about two V-cycles. That is done once the residual is so small that as a rule few
 * V-cycles are left, and again, up to five times, if the algebraic error at that time turns out not
 * to have been small beside it.
 */
class SMG_EXPORT ErrorBalance
{
public:
  /** Estimates the discretisation error with the present iterate. */
  using Measure = std::function<EnergySquares()>;

  /** The relative residual at which such solves end as a rule; for the progress. */
  static constexpr double UsualResidual = 1e-4;

  explicit ErrorBalance(Measure measure)
    : Estimate(std::move(measure))
  {
  }

  /** To be called after a V-cycle, with the energy of its iterate, the relative residual, and
   * the factor by which that fell. Returns whether the algebraic error is small enough. */
  bool add(double energy, double residual, double factor);

  /** Adds the errors of the last iterate to the report, as far as they are known, and a note. */
  void report(Report& report) const;

  template <class State>
  void exchange(State& state)
  {
    state.part("errors");
    state(this->Energies, this->Factor, this->Algebraic, this->Known, this->Mesh.error,
      this->Mesh.solution, this->AtMeasure, this->Measures);
  }

private:
  static constexpr double Unknown = std::numeric_limits<double>::infinity();

  void estimate(double energy, double factor);
  void measure();
  bool isEnough() const;
  bool isDisturbed() const;

  Measure Estimate;
  std::vector<double> Energies; ///< after each V-cycle
  double Factor = 1.0;          ///< by which the last residual fell
  double Algebraic = Unknown;   ///< squared, after the last V-cycle
  double Known = Unknown;       ///< the last value that was not Unknown
  EnergySquares Mesh;
  double AtMeasure = Unknown; ///< Algebraic when Mesh was estimated
  int Measures = 0;           ///< number of estimates
};

} // namespace smg
