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
 * continuous problem: when the algebraic error is below a tenth of that of the discretisation, both
 * in the energy norm.
 *
 * The squared algebraic error falls in V-cycle k by f_k = 2 (J_{k-1} - J_k), see IterateEnergy
 * (Hestenes and Stiefel 1952; Meurant and Tichy 2013). If further V-cycles multiply it by q, it is
 * f_k q / (1 - q). For q the larger one of f_k / f_{k-1} and the squared factors of the last two
 * residuals is taken. The discretisation error is estimated on the mesh, which is read again for
 * that, with the iterate. That costs about two V-cycles: so it is done once the residual is small
 * enough that as a rule few V-cycles are left, and again, up to five times, if the algebraic error
 * of that time turns out not to have been small beside it.
 */
class SMG_EXPORT ErrorBalance
{
public:
  /** Estimates the discretisation error with the present iterate. */
  using Measure = std::function<EnergySquares()>;

  /** The relative residual at which they end as a rule. */
  static constexpr double UsualResidual = 1e-4;

  explicit ErrorBalance(Measure measure)
    : Estimate(std::move(measure))
  {
  }

  /** After a V-cycle, with the energy of its iterate, the relative residual, and the factor of
   * that: whether the errors are as far apart as that. */
  bool add(double energy, double residual, double factor);

  /** Adds the errors of the last iterate, as far as they are known, and a note. */
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
  double Factor = 1.0;          ///< of the last residual
  double Algebraic = Unknown;   ///< squared, after the last V-cycle
  double Known = Unknown;       ///< the last one that was not unknown
  EnergySquares Mesh;
  double AtMeasure = Unknown; ///< Algebraic when Mesh was estimated
  int Measures = 0;           ///< how often it was
};

} // namespace smg
