// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/VaryingRightSide.h"

#include "Solver/Assembly/Components.h"
#include "Testing/Support/TestMeshes.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

// What convergence is measured against, compared with least squares in memory.

namespace smg::testing
{
namespace
{

/** Row sums and right-hand sides of the unknowns of a body. */
struct Rows
{
  Rows(std::uint64_t seed, Eigen::Index count, double offset, double range)
    : rowSums(count)
    , b(count)
  {
    Random random(seed);
    for (Eigen::Index i = 0; i < count; ++i)
    {
      // Most unknowns have no condition next to them.
      this->rowSums[i] = i % 7 == 0 ? random.uniform(0.1, 2.0) : 0.0;
      this->b[i] = this->rowSums[i] * (offset + range * random.uniform(-1.0, 1.0));
    }
  }

  double rest() const
  {
    const double c = this->rowSums.dot(this->b) / this->rowSums.squaredNorm();
    return (this->b - c * this->rowSums).norm();
  }
  void addTo(VaryingRightSide& sum, std::int32_t label, Eigen::Index begin, Eigen::Index end) const
  {
    for (Eigen::Index i = begin; i < end; ++i)
    {
      sum.add(label, this->rowSums[i], 1.0, &this->b[i], 1.0);
    }
  }

  Eigen::VectorXd rowSums, b;
};

double normOf(const VaryingRightSide& sum, const Components& components)
{
  return sum.norms(components).front();
}

} // namespace

TEST(VaryingRightSide, IsTheLeastSquaresOfAConstantWhateverTheOffset)
{
  for (const double offset : { 0.0, 1.0, 293.0, -1e6 })
  {
    const Rows rows(3, 200, offset, 1.0);
    Components components(1);
    const std::int32_t label = components.add();
    VaryingRightSide sum(1);
    rows.addTo(sum, label, 0, 200);
    EXPECT_NEAR(normOf(sum, components), Rows(3, 200, 0.0, 1.0).rest(), 1e-8);
  }
}

/** As of a source and a screening of 1e-4 to 1e-12 far from conditions: the constants of single
 * rows are up to 1e12 times that of all. */
TEST(VaryingRightSide, DoesNotDependOnTheOrderOfRowsOfAnySize)
{
  for (const double screening : { 1e-4, 1e-8, 1e-12 })
  {
    constexpr Eigen::Index Inside = 2000, Beside = 40;
    Rows rows(3, Inside + Beside, 0.0, 1.0);
    for (Eigen::Index i = 0; i < Inside; ++i)
    {
      rows.rowSums[i] = 1e-6 * screening;
      rows.b[i] = 1e-6;
    }
    rows.rowSums.tail(Beside).setOnes();
    rows.b.tail(Beside).setConstant(1e-9);
    const double expected = rows.rest();
    ASSERT_NEAR(expected, 1e-6 * std::sqrt(double(Inside)), 1e-8);
    Components components(1);
    const std::int32_t a = components.add(), b = components.add();
    components.join(a, b);
    for (const Eigen::Index first : { Eigen::Index(0), Inside })
    {
      VaryingRightSide whole(1), parts(1);
      rows.addTo(whole, a, first, Inside + Beside);
      rows.addTo(whole, a, 0, first);
      rows.addTo(parts, a, first, Inside + Beside);
      rows.addTo(parts, b, 0, first);
      EXPECT_NEAR(normOf(whole, components), expected, 1e-9 * expected);
      EXPECT_NEAR(normOf(parts, components), expected, 1e-9 * expected);
    }
  }
}

TEST(VaryingRightSide, JoinedLabelsAreOneBody)
{
  const Rows rows(5, 300, 1e4, 1e-3);
  Components components(1);
  const std::int32_t a = components.add(), b = components.add(), c = components.add();
  VaryingRightSide parts(1), whole(1);
  rows.addTo(parts, a, 0, 100);
  rows.addTo(parts, b, 100, 150);
  rows.addTo(parts, c, 150, 300);
  rows.addTo(whole, a, 0, 300);
  components.join(c, a);
  components.join(b, c);
  EXPECT_NEAR(normOf(parts, components) / rows.rest(), 1.0, 1e-6);
  EXPECT_NEAR(normOf(whole, components) / rows.rest(), 1.0, 1e-6);
}

TEST(VaryingRightSide, TheBodyOfTheLeastRangeCountsDownToATenThousandth)
{
  for (const double range : { 1.0, 1e-2, 1e-9, 0.0 })
  {
    const Rows large(7, 400, 0.0, 1.0), small(8, 400, 1e3, range);
    Components components(1);
    const std::int32_t a = components.add(), b = components.add();
    VaryingRightSide sum(1);
    large.addTo(sum, a, 0, 400);
    small.addTo(sum, b, 0, 400);
    const double all = std::hypot(large.rest(), range > 0.0 ? small.rest() : 0.0);
    const double least = std::sqrt(2.0) * std::min(large.rest(), small.rest());
    const double expected = range > 0.0 ? std::max(std::min(all, least), 1e-4 * all) : all;
    EXPECT_NEAR(normOf(sum, components) / expected, 1.0, 1e-6) << range;
  }
}

TEST(VaryingRightSide, AConstantIsMeasuredByATenThousandthOfIt)
{
  const Rows rows(9, 100, 5.0, 0.0);
  Components components(1);
  VaryingRightSide sum(1);
  rows.addTo(sum, components.add(), 0, 100);
  EXPECT_NEAR(normOf(sum, components) / (1e-4 * rows.b.norm()), 1.0, 1e-12);
}

TEST(VaryingRightSide, OfABodyThatNothingHoldsConstantSourcesDoNotCount)
{
  Components components(1);
  const std::int32_t label = components.add();
  VaryingRightSide constant(1), varying(1);
  double squares = 0.0;
  for (int i = 0; i < 50; ++i)
  {
    const double mass = 1.0 + i % 3, wave = i % 2 ? mass : -mass;
    const double b = 3.0 * mass, with = b + wave;
    constant.add(label, 0.0, mass, &b, 1.0);
    varying.add(label, 0.0, mass, &with, 1.0);
    squares += wave * wave;
  }
  EXPECT_EQ(normOf(constant, components), 0.0);
  EXPECT_NEAR(normOf(varying, components) / std::sqrt(squares), 1.0, 0.05);
}

} // namespace smg::testing
