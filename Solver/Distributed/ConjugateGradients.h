// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/HypreObjects.h"
#include "Solver/Multigrid/Engine/Convergence.h"

#include <functional>
#include <span>
#include <vector>

namespace smg
{

/** Conjugate gradients preconditioned by a V-cycle of BoomerAMG. All functions are called on all
 * processes. */
class ConjugateGradients
{
public:
  ConjugateGradients(Team& team, const HypreRows& rows, const HypreMatrix& matrix);

  /** b - A x of the rows of this process, valid until the next call. */
  std::span<const double> residual(std::span<const double> b, std::span<const double> x);

  /** Iterates from x until `convergence` ends it, which gets the residual after each iteration.
   * `share`: see commonShare(). `iterated` is called after each iteration and may throw. */
  void solve(std::span<const double> b, std::span<double> x, std::span<const double> share,
    Convergence& convergence, const std::function<void()>& iterated);

private:
  using Numbers = std::vector<double>;

  void setResidual(std::span<const double> b, std::span<const double> x);
  void multiply(std::span<const double> x, std::span<double> product); ///< A x
  void precondition();                                                 ///< Z = M R
  double dot(const Numbers& a, const Numbers& b) const;
  double norm(std::span<const double> share) const; ///< of R

  Team& Processes;
  const HypreMatrix& A;
  HypreVector From, To;
  BoomerAmg Amg;
  Numbers R, Z, P, Q;
};

} // namespace smg
