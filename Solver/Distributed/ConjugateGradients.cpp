// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/ConjugateGradients.h"

#include "Solver/Multigrid/Cycle/RowShare.h"

#include <HYPRE_parcsr_mv.h>

#include <cmath>
#include <numeric>

// Conjugate gradients with a V-cycle of hypre's BoomerAMG as preconditioner, for one right-hand
// side. The V-cycle is symmetric (HypreObjects.cpp), which conjugate gradients require. The
// iteration is the library's own, not hypre's, so that it stops by the same criterion as the
// streaming engine (Convergence), reports progress and can be cancelled.
//
// An iteration costs a V-cycle, a product with the matrix and three sums over all processes.
// Vectors are plain arrays with the own rows; hypre gets copies.

namespace smg
{

ConjugateGradients::ConjugateGradients(Team& team, const HypreRows& rows, const HypreMatrix& matrix)
  : Processes(team)
  , A(matrix)
  , From(team, rows)
  , To(team, rows)
  , Amg(matrix, this->From, this->To)
  , R(static_cast<std::size_t>(rows.count()))
  , Z(this->R)
  , P(this->R)
  , Q(this->R)
{
}

std::span<const double> ConjugateGradients::residual(
  std::span<const double> b, std::span<const double> x)
{
  this->Processes.agree();
  this->setResidual(b, x);
  return this->R;
}

void ConjugateGradients::setResidual(std::span<const double> b, std::span<const double> x)
{
  // R serves as the place for the product first.
  this->multiply(x, this->R);
  for (std::size_t k = 0; k < this->R.size(); ++k)
  {
    this->R[k] = b[k] - this->R[k];
  }
}

void ConjugateGradients::multiply(std::span<const double> x, std::span<double> product)
{
  // From and To serve the products and the preconditioner alike: two vectors of hypre for all.
  this->From.set(x);
  HYPRE_ParCSRMatrixMatvec(
    1.0, this->A.parallel(), this->From.parallel(), 0.0, this->To.parallel());
  this->To.get(product);
}

void ConjugateGradients::precondition()
{
  this->From.set(this->R);
  this->Amg.apply(this->From, this->To);
  this->To.get(this->Z);
}

/** Without Team::agree(): nothing in an iteration can fail on one process alone, and its end has
 * one. */
double ConjugateGradients::dot(const Numbers& a, const Numbers& b) const
{
  double product = std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  MPI_Allreduce(MPI_IN_PLACE, &product, 1, MPI_DOUBLE, MPI_SUM, this->Processes.communicator());
  return product;
}

/** The norm of the residual, in which rows count as in the streaming engine. */
double ConjugateGradients::norm(std::span<const double> share) const
{
  double squares = 0.0;
  for (std::size_t k = 0; k < this->R.size(); ++k)
  {
    const double counted = residualShare(share[k]) * this->R[k];
    squares += counted * counted;
  }
  MPI_Allreduce(MPI_IN_PLACE, &squares, 1, MPI_DOUBLE, MPI_SUM, this->Processes.communicator());
  return std::sqrt(squares);
}

void ConjugateGradients::solve(std::span<const double> b, std::span<double> x,
  std::span<const double> share, Convergence& convergence, const std::function<void()>& iterated)
{
  this->Processes.agree();
  // The convergence criterion compares with the residual of the values to begin with.
  this->setResidual(b, x);
  convergence.begin(this->norm(share));
  double before = 0.0;
  while (!convergence.done())
  {
    this->precondition();
    const double product = this->dot(this->R, this->Z);
    // The first direction is the preconditioned residual itself; later ones are conjugate to the
    // one before.
    const double beta = before > 0.0 ? product / before : 0.0;
    for (std::size_t k = 0; k < this->P.size(); ++k)
    {
      this->P[k] = this->Z[k] + beta * this->P[k];
    }
    this->multiply(this->P, this->Q);
    const double step = product / this->dot(this->P, this->Q);
    for (std::size_t k = 0; k < this->P.size(); ++k)
    {
      x[k] += step * this->P[k];
      this->R[k] -= step * this->Q[k];
    }
    before = product;
    // All processes have the same norm, so they stop after the same iteration.
    double norm = this->norm(share);
    if (convergence.meets(norm))
    {
      // R is updated, not computed, and drifts from b - A x by rounding. Before it counts as
      // converged, the true residual is computed; if that is still too large, the iteration goes on
      // from it.
      this->setResidual(b, x);
      norm = this->norm(share);
    }
    convergence.add(norm);
    iterated();
    this->Processes.agree(); // nothing else may fail in an iteration on one process alone
  }
}

} // namespace smg
