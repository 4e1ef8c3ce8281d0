// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/Chebyshev.h"
#include "Solver/Engine/ConjugateResiduals.h"
#include "Solver/Engine/Convergence.h"
#include "smg/Export.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <optional>
#include <string>
#include <vector>

namespace smg
{

/**
 * Decides from V-cycle to V-cycle whether and how the next one is accelerated. A solve of a fixed
 * number of V-cycles is not.
 */
class SMG_EXPORT Acceleration
{
public:
  /** `convergence` has begun and outlives this. */
  Acceleration(AccelerationKind wanted, const Convergence& convergence);

  /** None, Chebyshev or ConjugateGradients: of the next V-cycle. */
  AccelerationKind kind() const { return this->Kind; }
  /** Before each V-cycle: decides. */
  void decide();
  /** The next V-cycle's weights, if it is accelerated. `products`: of the last one's history. */
  StepWeights next(const ResidualProducts& products);
  /** No acceleration from here on, because of what `reason` says. */
  void giveUp(const std::string& reason);

  /** "none", or what was last used: "chebyshev" or "cg". */
  const char* used() const { return this->Used; }
  void addNotes(std::vector<std::string>& notes, const std::string& what) const;

private:
  bool pays() const;
  void begin();
  void watchPolynomial();

  const Convergence& Watched;
  AccelerationKind Wanted;
  AccelerationKind Kind = AccelerationKind::None;
  std::optional<Chebyshev> Polynomial;
  ConjugateResiduals Directions;
  double Bound = 0.0;
  int Begun = 0; // V-cycles before the polynomial began
  const char* Used = "none";
  std::string Note;
};

} // namespace smg
