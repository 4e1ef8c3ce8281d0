// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Report.h"

#include <string>
#include <vector>

namespace smg
{

/** The stopping criterion for the V-cycles of a problem. */
struct Stopping
{
  double tolerance = 1e-6; ///< of the residual, relative to FirstResidual::reference
  int maxCycles = 50;
  /**
   * The exact number of V-cycles, regardless of the residual; 0: until the tolerance is reached.
   */
  int cycles = 0;
};

/** The residual of the initial values. */
struct FirstResidual
{
  double norm = 0.0;      ///< ||b - A x_0||
  double rounding = 0.0;  ///< the part of it that is due to the rounding of its terms
  double reference = 0.0; ///< what residuals are relative to
};

/**
 * Follows the residual of a problem over the V-cycles and decides when to stop: at the tolerance,
 * at the limit of rounding, when it stagnates, at the largest number of V-cycles, or, with an
 * Error, when it diverges or overflows. The relative residual is ||b - A x|| over what the problem
 * weighs, whatever the initial values: the residual of the best constant (VaryingRightSide), or,
 * where unknowns are displacements, that of the mesh at rest. If coefficients differ much, and much
 * less flows than that, the goal is smaller by as much (IterateFlow), and rows that are divided by
 * their diagonals must meet the tolerance, too.
 */
class SMG_EXPORT Convergence
{
public:
  Convergence(const Stopping& stopping, const FirstResidual& first);

  /** To be called before the first V-cycle, with the norm after the first sweeps. This may
   * already end the solve, unless the right-hand side has changed since. */
  void begin(double norm, bool mayEnd = true);
  /** To be called after a V-cycle; `rounding`: the part of the norm that is due to the rounding
   * of its terms, if that is more than initially; `share`, `scaled`: see
   * SolveContext::shareOfTolerance(), scaledResidual(). Throws Error if the residual diverges or
   * overflows. */
  void add(double norm, double rounding = 0.0, double share = 1.0, double scaled = 0.0);

  /** The last V-cycle was enough, for another reason than its residual. */
  void end()
  {
    this->Done = this->Converged = true;
    this->Note.clear();
  }

  /** Whether a residual of this norm meets the tolerance. */
  bool meets(double norm) const { return norm <= this->Goal; }
  /** The relative residual to reach. */
  double goal() const { return this->Reference > 0.0 ? this->Goal / this->Reference : 1.0; }
  /** The residual that relative ones are relative to. */
  double reference() const { return this->Reference; }
  /** The relative residual of the initial values. */
  double initial() const { return this->Initial; }
  /** The part of the residual that is due to the rounding of its terms. */
  double rounding() const { return this->Rounding; }
  bool done() const { return this->Done; }
  bool converged() const { return this->Converged; }
  int cycles() const { return static_cast<int>(this->Residuals.size()); }
  /** Whether the next V-cycle is the last allowed one. */
  bool isLast() const { return this->cycles() + 1 >= this->Limit; }
  /** The last ||b - A x||, and the relative residual after each V-cycle. */
  double norm() const { return this->Norm; }
  const std::vector<double>& residuals() const { return this->Residuals; }
  /** Whether the number of V-cycles is given. */
  bool fixed() const { return this->Fixed; }
  /** The factor of ||b - A x|| in the last V-cycle. */
  double factor() const { return this->Norm / this->NormBefore; }
  /** The number of V-cycles to the tolerance if each multiplies the residual by `factor`, in (0,
   * 1). */
  double cyclesLeft(double factor) const;
  /** Saves or restores all but the stopping criterion, which is that of the constructor. */
  template <class State>
  void exchange(State& state)
  {
    state.part("convergence");
    state(this->Initial, this->Rounding, this->Reference, this->Least, this->Goal, this->FirstNorm,
      this->NormBefore, this->Norm, this->Residuals, this->ScaledResiduals, this->Note, this->Done,
      this->Converged);
  }
  /** Adds notes for the user that begin with `what`. */
  void addNotes(Report& report, const std::string& what) const;
  /** Adds the V-cycles of one of several problems to the report; its notes begin with `what`. */
  void addStep(Report& report, const std::string& name, const std::string& what) const;

private:
  void setGoal(double share, double rounding);
  void watch();

  bool Fixed;
  int Limit;
  double Tolerance;
  double Rounding, Reference;
  /** The least goal: the rounding, if the initial values solve the problem up to that. */
  double Least;
  double Goal;
  double Initial;
  double FirstNorm = 0.0, NormBefore = 0.0, Norm = 0.0;
  std::vector<double> Residuals, ScaledResiduals;
  std::string Note;
  bool Done = false, Converged = false;
};

/** What residuals are relative to, in reports. */
inline constexpr const char *BestConstant = "the best constant", *MeshAtRest = "the mesh at rest";

/** Whether a note is on the residual with which a solve has converged. */
bool isOnResidual(const std::string& note);

/** The norm of the rounding of the terms of b - A x, given the sum of their squares. */
SMG_EXPORT double roundingOf(double termSquares);

/** "1.23e-07" */
std::string scientific(double value);

} // namespace smg
