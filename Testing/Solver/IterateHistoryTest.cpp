// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Engine/Chebyshev.h"
#include "Solver/Engine/ConjugateResiduals.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>

// On a diagonal model: A is the identity, and a V-cycle T multiplies the error of node i by t_i.

namespace smg::testing
{
namespace
{

class DiagonalModel
{
public:
  DiagonalModel(Eigen::VectorXd factors, bool residuals)
    : Factors(std::move(factors))
    , Memory(std::int64_t(1) << 24)
    , Errors(this->Memory)
    , History(this->Memory, 1, residuals)
  {
    this->Errors.extend(this->Factors.size());
    this->error().setOnes();
  }

  /** y_k - x; its residual is its negative. */
  Eigen::Map<Eigen::VectorXd> error() { return { this->Errors.at(0), this->Factors.size() }; }
  ResidualProducts products() const { return this->History.products(); }

  void pass(const StepWeights& weights)
  {
    const std::int64_t end = this->Factors.size();
    this->History.startPass(weights);
    this->History.load(this->Errors, end);
    this->error().array() *= this->Factors.array();
    this->History.combine(this->Errors, 0, end);
    for (std::int64_t i = 0; this->History.keepsResiduals() && i < end; ++i)
    {
      using One = Lanes<double, 1>;
      const double residual = -this->Errors[i];
      this->History.addResidual<One>(i, 0, One::load(&residual));
    }
    this->History.endPass();
  }

private:
  Eigen::VectorXd Factors;
  Pool Memory;
  Ring<double> Errors;
  IterateHistory History;
};

/** The Chebyshev polynomial C_k. */
double chebyshev(int k, double x)
{
  return std::fabs(x) <= 1
           ? std::cos(k * std::acos(x))
           : std::pow(x < 0 ? -1.0 : 1.0, k) * std::cosh(k * std::acosh(std::fabs(x)));
}

} // namespace

TEST(IterateHistory, chebyshevWeightsGiveChebyshevPolynomials)
{
  const double bound = 0.6;
  const Eigen::VectorXd factors = Eigen::VectorXd::LinSpaced(41, -0.7, 0.9);
  DiagonalModel model(factors, false);
  Chebyshev polynomial(bound);
  for (int k = 1; k <= 9; ++k)
  {
    model.pass(polynomial.next());
    for (Eigen::Index i = 0; i < factors.size(); ++i)
    {
      const double expected = chebyshev(k, factors[i] / bound) / chebyshev(k, 1 / bound);
      // Steps are kept in single precision.
      EXPECT_NEAR(model.error()[i], expected, 1e-6 * std::max(1.0, std::fabs(expected))) << k;
    }
  }
}

TEST(IterateHistory, conjugateResidualsEndAfterAsManyStepsAsThereAreFactors)
{
  const double values[] = { -0.5, 0.3, 0.7, 0.95 };
  Eigen::VectorXd factors(100);
  for (Eigen::Index i = 0; i < factors.size(); ++i)
  {
    factors[i] = values[i % 4];
  }
  DiagonalModel model(factors, true);
  ConjugateResiduals directions;
  // The first pass begins, the second one gives the first direction: then one for each factor.
  for (int k = 0; k < 2 + 4; ++k)
  {
    model.pass(directions.next(model.products()));
  }
  EXPECT_LT(model.error().norm(), 1e-4 * std::pow(0.95, 6) * 10);
}

TEST(IterateHistory, conjugateResidualsMinimiseTheResidual)
{
  // After the first direction: the best multiple of it, z_1 = z_0 + length (T z_0 - z_0).
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(30, -0.3, 0.9);
  DiagonalModel model(t, true);
  ConjugateResiduals directions;
  model.pass(directions.next(model.products()));
  const Eigen::VectorXd z = model.error();
  model.pass(directions.next(model.products()));
  const StepWeights weights = directions.next(model.products());
  const Eigen::VectorXd direction = t.cwiseProduct(z) - z;
  const double best = -z.dot(direction) / direction.squaredNorm();
  EXPECT_NEAR(weights.length, best, 1e-6);
  model.pass(weights);
  const Eigen::VectorXd expected = t.cwiseProduct(z + best * direction);
  EXPECT_LT((model.error() - expected).norm(), 1e-6 * z.norm());
}

TEST(IterateHistory, conjugateResidualsBeginAnewWhenTheProductsBreakDown)
{
  ConjugateResiduals directions;
  const ResidualProducts none;
  EXPECT_TRUE(directions.next(none).begin);
  EXPECT_FALSE(directions.next(none).begin);
  const StepWeights weights = directions.next(none);
  EXPECT_TRUE(weights.begin);
  EXPECT_EQ(weights.correction, 1.0);
  EXPECT_EQ(weights.momentum, 0.0);
}

} // namespace smg::testing
