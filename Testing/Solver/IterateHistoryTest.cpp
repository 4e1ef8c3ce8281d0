// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/Acceleration.h"
#include "Testing/Support/TemporaryFolder.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

// A diagonal model: A is the identity, and a V-cycle T multiplies the error of node i by t_i.

namespace smg::testing
{
namespace
{

class DiagonalModel
{
public:
  DiagonalModel(Eigen::VectorXd factors, KeptResiduals residuals)
    : Factors(std::move(factors))
    , Memory(std::int64_t(1) << 28)
    , Errors(this->Memory)
    , History(this->Memory, this->Factors.size(), 1, residuals)
  {
    this->Errors.extend(this->Factors.size());
    this->error().setOnes();
  }

  /** Keeps the history on disk. */
  void useScratch(const ScratchFolder& folder) { this->History.useScratch(folder, this->Traffic); }

  /** y_k - x; its residual is its negative. */
  Eigen::Map<Eigen::VectorXd> error() { return { this->Errors.at(0), this->Factors.size() }; }
  ResidualProducts products() const { return this->History.products(); }

  void pass(const StepWeights& weights)
  {
    const std::int64_t end = this->Factors.size();
    this->History.startPass(weights);
    this->History.load(end);
    this->History.keep(this->Errors);
    this->error().array() *= this->Factors.array();
    this->History.combine(this->Errors, 0, end);
    using One = SimdPack<double, 1>;
    for (std::int64_t first = 0; first < end; first += RowBlock::Nodes)
    {
      ResidualKeeper<One> keep(&this->History, first, 0);
      for (std::int64_t i = first; i < std::min(end, first + RowBlock::Nodes); ++i)
      {
        const double residual = -this->Errors[i];
        keep(i - first, One::load(&residual));
      }
    }
    this->History.write(end);
    this->History.release();
    this->History.endPass();
  }

private:
  Eigen::VectorXd Factors;
  Pool Memory;
  Ring<double> Errors;
  IoStatistics Traffic;
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

TEST(IterateHistory, ChebyshevWeightsGiveChebyshevPolynomials)
{
  const double bound = 0.6;
  const Eigen::VectorXd factors = Eigen::VectorXd::LinSpaced(41, -0.7, 0.9);
  DiagonalModel model(factors, KeptResiduals::None);
  Chebyshev polynomial(bound);
  for (int k = 1; k <= 9; ++k)
  {
    model.pass(polynomial.next());
    for (Eigen::Index i = 0; i < factors.size(); ++i)
    {
      const double expected = chebyshev(k, factors[i] / bound) / chebyshev(k, 1 / bound);
      // Steps are stored in single precision.
      EXPECT_NEAR(model.error()[i], expected, 1e-6 * std::max(1.0, std::fabs(expected))) << k;
    }
  }
}

TEST(IterateHistory, ConjugateResidualsEndAfterAsManyStepsAsThereAreFactors)
{
  const double values[] = { -0.5, 0.3, 0.7, 0.95 };
  Eigen::VectorXd factors(100);
  for (Eigen::Index i = 0; i < factors.size(); ++i)
  {
    factors[i] = values[i % 4];
  }
  DiagonalModel model(factors, KeptResiduals::Sampled);
  ConjugateResiduals directions;
  // The second pass yields the first direction; then one more for each factor.
  for (int k = 0; k < 2 + 4; ++k)
  {
    model.pass(directions.next(model.products()));
  }
  EXPECT_LT(model.error().norm(), 1e-4 * std::pow(0.95, 6) * 10);
}

TEST(IterateHistory, ASampleOfTheNodesTellsTheWeightsOfAllOfThem)
{
  // The groups differ in a pattern of eight: one group in eight or sixteen, if not always the same
  // one, yields nearly the weights of all.
  const auto weightsOf = [](std::int64_t nodes, KeptResiduals residuals)
  {
    Eigen::VectorXd factors(nodes);
    for (Eigen::Index i = 0; i < nodes; ++i)
    {
      const double group = static_cast<double>(i / 64 % 8 + 1) / 8;
      factors[i] = 0.9 * group * std::sin(static_cast<double>(i % 64));
    }
    DiagonalModel model(factors, residuals);
    ConjugateResiduals directions;
    for (int k = 0; k < 4; ++k)
    {
      model.pass(directions.next(model.products()));
    }
    EXPECT_GT(model.products().aa, 0.0);
    return directions.next(model.products());
  };
  const StepWeights all = weightsOf(1 << 13, KeptResiduals::Sampled); // few: all of them
  const StepWeights kept = weightsOf(1 << 19, KeptResiduals::All);
  EXPECT_NEAR(kept.length, all.length, 1e-6);
  EXPECT_NEAR(kept.conjugation, all.conjugation, 1e-6);
  for (const std::int64_t nodes : { 1 << 19, 1 << 23 })
  {
    const StepWeights sample = weightsOf(nodes, KeptResiduals::Sampled);
    EXPECT_NEAR(sample.length, all.length, 0.02 * std::fabs(all.length));
    EXPECT_NEAR(sample.conjugation, all.conjugation, 0.02);
  }
}

TEST(IterateHistory, OnDiskIsTheSameAsInMemory)
{
  const TemporaryFolder folder;
  const Eigen::VectorXd factors = Eigen::VectorXd::LinSpaced((1 << 19) + 700, -0.4, 0.9);
  DiagonalModel inMemory(factors, KeptResiduals::Sampled);
  DiagonalModel onDisk(factors, KeptResiduals::Sampled);
  onDisk.useScratch(ScratchFolder(folder.path()));
  ConjugateResiduals directions[2];
  for (int k = 0; k < 6; ++k)
  {
    inMemory.pass(directions[0].next(inMemory.products()));
    onDisk.pass(directions[1].next(onDisk.products()));
  }
  EXPECT_TRUE(inMemory.error() == onDisk.error());
  EXPECT_LT(inMemory.error().norm(), 0.1 * std::pow(0.9, 6) * std::sqrt(factors.size()));
}

TEST(IterateHistory, ConjugateResidualsMinimiseTheResidual)
{
  // After the first direction: the best multiple of it, z_1 = z_0 + length (T z_0 - z_0).
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(30, -0.3, 0.9);
  DiagonalModel model(t, KeptResiduals::Sampled);
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

TEST(IterateHistory, ConjugateResidualsBeginAnewWhenTheProductsBreakDown)
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
