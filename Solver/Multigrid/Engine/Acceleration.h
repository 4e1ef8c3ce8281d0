// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/Chebyshev.h"
#include "Solver/Multigrid/Engine/ConjugateResiduals.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "smg/Export.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <optional>
#include <string>
#include <vector>

namespace smg
{

/** Decides before each V-cycle whether and how it is accelerated. Solves with a fixed number of
 * V-cycles are not accelerated. */
class SMG_EXPORT Acceleration
{
public:
  /** `convergence` has begun and must outlive this object. */
  Acceleration(AccelerationKind wanted, const Convergence& convergence);

  /** The method of the next V-cycle: None, Chebyshev or ConjugateGradients. */
  AccelerationKind kind() const { return this->Kind; }
  /** Decides; to be called before each V-cycle. */
  void decide();
  /** The weights of the next V-cycle if it is accelerated. `products`: of the history of the last
   * one. */
  StepWeights next(const ResidualProducts& products);
  bool isWanted() const { return this->Wanted != AccelerationKind::None; }
  /** The memory limit has no room for what kind() keeps: takes Chebyshev polynomials, which keep
   * least, from the third V-cycle on, or if there is no room for these either, none. */
  void saveMemory();

  /** "none", or the method that was last used: "chebyshev" or "cg". */
  const char* used() const { return nameOf(this->Used); }
  void addNotes(std::vector<std::string>& notes, const std::string& what) const;

  template <class State>
  void exchange(State& state)
  {
    state.part("acceleration");
    state(this->Wanted, this->Kind, this->Polynomial, this->Directions, this->Bound, this->Begun,
      this->Used, this->Note);
  }

private:
  static const char* nameOf(AccelerationKind kind);
  bool pays() const;
  void begin();
  void watchPolynomial();
  void giveUp(const std::string& reason);

  const Convergence& Watched;
  AccelerationKind Wanted;
  AccelerationKind Kind = AccelerationKind::None;
  std::optional<Chebyshev> Polynomial;
  ConjugateResiduals Directions;
  double Bound = 0.0;
  int Begun = 0; // V-cycles before the polynomial began
  AccelerationKind Used = AccelerationKind::None;
  std::string Note;
};

} // namespace smg
