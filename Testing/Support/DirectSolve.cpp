// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/DirectSolve.h"

#include "smg/Error.h"

#include <Eigen/CholmodSupport>

namespace smg::testing
{
namespace
{

/** The weight of each unknown in the means of its component: its mass, or 1 if no vertex of the
 * component has mass. */
Eigen::VectorXd weights(const DirectSystem& system)
{
  Eigen::VectorXd mass = system.mass(system.freeVertices);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(system.isFloating.size());
  for (Eigen::Index i = 0; i < mass.size(); ++i)
  {
    sums[system.component[i]] += mass[i];
  }
  for (Eigen::Index i = 0; i < mass.size(); ++i)
  {
    mass[i] = sums[system.component[i]] > 0 ? mass[i] : 1.0;
  }
  return mass;
}

/** The sum of x over each component divided by that of its weights, one row per component. */
Eigen::MatrixXd quotients(const DirectSystem& system, const Eigen::MatrixXd& x)
{
  const Eigen::VectorXd weight = weights(system);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(system.isFloating.size(), x.cols());
  Eigen::VectorXd all = Eigen::VectorXd::Zero(system.isFloating.size());
  for (Eigen::Index i = 0; i < x.rows(); ++i)
  {
    sum.row(system.component[i]) += x.row(i);
    all[system.component[i]] += weight[i];
  }
  return all.cwiseInverse().asDiagonal() * sum;
}

/** Adds row c of `shift`, times `weight`, to the unknowns of each floating component c. */
void shiftFloating(const DirectSystem& system, const Eigen::MatrixXd& shift,
  const Eigen::VectorXd& weight, Eigen::MatrixXd& x)
{
  for (Eigen::Index i = 0; i < x.rows(); ++i)
  {
    if (system.isFloating[system.component[i]])
    {
      x.row(i) += weight[i] * shift.row(system.component[i]);
    }
  }
}

} // namespace

Eigen::MatrixXd solveDirect(const DirectSystem& system)
{
  Eigen::SparseMatrix<double> matrix = system.matrix;
  Eigen::MatrixXd b = system.rightSide;
  const Eigen::VectorXd weight = weights(system);
  shiftFloating(system, -quotients(system, b), weight, b);

  // Adding 1 to the diagonal prescribes 0 at the first vertex of a floating component: the rows of
  // the component and b sum to zero, hence the value of that vertex is zero.
  std::vector<std::uint8_t> done(system.isFloating.size(), 0);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
  {
    const int component = system.component[i];
    if (system.isFloating[component] && !done[component])
    {
      matrix.coeffRef(i, i) *= 2;
      done[component] = 1;
    }
  }

  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(b.rows(), b.cols());
  if (b.rows() > 0)
  {
    const Eigen::CholmodSimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    if (factor.info() != Eigen::Success)
    {
      throw Error("CHOLMOD could not factorise the system: it is not positive definite.");
    }
    x = factor.solve(b);
  }
  shiftFloating(system, quotients(system, weight.asDiagonal() * (system.initial() - x)),
    Eigen::VectorXd::Ones(b.rows()), x);
  return system.scatter(x);
}

double relativeError(const Eigen::MatrixXd& values, const Eigen::MatrixXd& expected)
{
  const double range = expected.maxCoeff() - expected.minCoeff();
  return (values - expected).cwiseAbs().maxCoeff() / (range > 0 ? range : 1.0);
}

} // namespace smg::testing
