// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DeformationDescription.h"

#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/NotNumbers.h"

#include <cmath>
#include <functional>
#include <numbers>

namespace smg::testing
{
namespace
{

using Vector = std::array<double, 3>;

void expectNear(const Vector& a, const Vector& b, double tolerance = 1e-14)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
  }
}

Vector moved(const HandleMotion& motion, const Vector& point)
{
  return motion.apply(point);
}

/** The error message of a motion with these parameters. */
std::string complaint(const std::function<void(HandleMotion::Parameters&)>& change)
{
  HandleMotion::Parameters parameters;
  change(parameters);
  return messageOf([&parameters] { HandleMotion{ parameters }; });
}

std::array<double, 16> matrixOf(const std::array<double, 9>& m, const Vector& t)
{
  return { m[0], m[1], m[2], t[0], m[3], m[4], m[5], t[1], m[6], m[7], m[8], t[2], 0, 0, 0, 1 };
}

} // namespace

TEST(HandleMotion, IdentityGivesThePointBackExactly)
{
  const Vector point{ 0.1, -1e-17, 12345.6789 };
  HandleMotion::Parameters parameters;
  parameters.center = { 1e8, 0.3, -7.7 };
  for (const double degrees : { 0.0, 360.0, -720.0 })
  {
    parameters.degrees = degrees;
    EXPECT_EQ(moved(HandleMotion(parameters), point), point);
  }
  EXPECT_EQ(moved(HandleMotion(), point), point);
  const HandleMotion matrix = HandleMotion::fromMatrix(matrixOf({ 1, 0, 0, 0, 1, 0, 0, 0, 1 }, {}));
  EXPECT_EQ(moved(matrix, point), point);
  EXPECT_EQ(matrix.rotation(), (Vector{ 0, 0, 0 }));
  EXPECT_EQ(matrix.logScale(), 0.0);
}

TEST(HandleMotion, OnlyWhatNeitherMovesNorTurnsIsTheIdentity)
{
  using Parameters = HandleMotion::Parameters;
  const auto isIdentity = [](const std::function<void(Parameters&)>& change)
  {
    Parameters parameters;
    parameters.center = { 1, 2, 3 };
    change(parameters);
    return HandleMotion(parameters).isIdentity();
  };
  EXPECT_TRUE(HandleMotion().isIdentity());
  EXPECT_TRUE(isIdentity([](Parameters&) {}));
  EXPECT_FALSE(isIdentity([](Parameters& p) { p.translation[2] = 1e-9; }));
  EXPECT_FALSE(isIdentity([](Parameters& p) { p.degrees = 360; }));
  EXPECT_FALSE(isIdentity([](Parameters& p) { p.scale = 2; }));
}

TEST(HandleMotion, RotationAndScaleComeBeforeTranslation)
{
  HandleMotion::Parameters parameters;
  parameters.translation = { 10, 20, 30 };
  parameters.axis = { 0, 0, 5 };
  parameters.degrees = 90;
  parameters.center = { 1, 1, 1 };
  parameters.scale = 2;
  const HandleMotion motion(parameters);
  expectNear(moved(motion, { 2, 1, 1 }), { 11, 23, 31 });
  EXPECT_EQ(moved(motion, parameters.center), (Vector{ 11, 21, 31 }));
  expectNear(motion.rotation(), { 0, 0, std::numbers::pi / 2 });
  EXPECT_DOUBLE_EQ(motion.logScale(), std::log(2.0));
}

TEST(HandleMotion, AnglesOfAnySizeKeepTheirTurns)
{
  for (const double degrees : { 200.0, -200.0, 720.0, -720090.0 })
  {
    HandleMotion::Parameters parameters;
    parameters.axis = { -3, 0, 0 };
    parameters.degrees = degrees;
    const HandleMotion motion(parameters);
    const double radians = degrees * std::numbers::pi / 180;
    expectNear(motion.rotation(), { -radians, 0, 0 }, 1e-12 * std::abs(radians));
    const double turn = std::remainder(degrees, 360.0) * std::numbers::pi / 180;
    expectNear(moved(motion, { 0, 1, 0 }), { 0, std::cos(turn), -std::sin(turn) });
  }
}

TEST(HandleMotion, AnAxisMayHaveAnyLength)
{
  for (const double length : { 1e-310, 1e-200, 1.0, 1e200 })
  {
    HandleMotion::Parameters parameters;
    parameters.axis = { 0, length, length };
    parameters.degrees = 180;
    expectNear(moved(HandleMotion(parameters), { 0, 1, 0 }), { 0, 0, 1 });
  }
}

TEST(HandleMotion, MatrixOfTheSameMotionSaysTheSame)
{
  HandleMotion::Parameters parameters;
  parameters.translation = { 1, -2, 3 };
  parameters.axis = { 1, 2, -2 };
  parameters.degrees = 130;
  parameters.center = { 4, 5, 6 };
  parameters.scale = 1.7;
  const HandleMotion motion(parameters);
  const Vector origin = moved(motion, { 0, 0, 0 });
  std::array<double, 9> linear{};
  for (std::size_t column = 0; column < 3; ++column)
  {
    Vector unit{};
    unit[column] = 1;
    const Vector image = moved(motion, unit);
    for (std::size_t row = 0; row < 3; ++row)
    {
      linear[3 * row + column] = image[row] - origin[row];
    }
  }
  const HandleMotion matrix = HandleMotion::fromMatrix(matrixOf(linear, origin));
  expectNear(matrix.rotation(), motion.rotation(), 1e-13);
  EXPECT_NEAR(matrix.logScale(), motion.logScale(), 1e-14);
  expectNear(moved(matrix, { -1, 7, 2 }), moved(motion, { -1, 7, 2 }), 1e-13);
}

TEST(HandleMotion, MatrixIsKeptAndItsRotationIsTheNearest)
{
  // A stretch followed by a rotation, which the polar decomposition recovers.
  const HandleMotion motion =
    HandleMotion::fromMatrix(matrixOf({ 0, -4, 0, 2, 0, 0, 0, 0, 1 }, { 0, 0, 0 }));
  expectNear(motion.rotation(), { 0, 0, std::numbers::pi / 2 });
  EXPECT_NEAR(motion.logScale(), std::log(2.0), 1e-15);
  EXPECT_EQ(moved(motion, { 1, 1, 1 }), (Vector{ -4, 2, 1 }));

  const HandleMotion half =
    HandleMotion::fromMatrix(matrixOf({ -1, 0, 0, 0, -1, 0, 0, 0, 1 }, { 0, 0, 0 }));
  EXPECT_NEAR(std::abs(half.rotation()[2]), std::numbers::pi, 1e-14);
}

TEST(HandleMotion, ErrorsSayWhatIsWrong)
{
  using Parameters = HandleMotion::Parameters;
  const auto contains = [](const std::string& text, const char* part)
  { EXPECT_NE(text.find(part), std::string::npos) << "got: '" << text << "'"; };
  contains(complaint([](Parameters& p) { p.translation[1] = NotANumber; }), "translation");
  contains(complaint([](Parameters& p) { p.axis[0] = Infinite; }), "axis of a handle");
  contains(complaint([](Parameters& p) { p.degrees = NotANumber; }), "angle");
  contains(complaint([](Parameters& p) { p.center[2] = Infinite; }), "centre");
  contains(complaint([](Parameters& p) { p.scale = NotANumber; }), "scale");
  contains(complaint([](Parameters& p) { p.scale = 0.0; }), "greater than 0");
  contains(complaint([](Parameters& p) { p.scale = -1.0; }), "greater than 0");
  contains(complaint([](Parameters& p) { p.scale = 9e-21; }), "1e-20");
  contains(complaint([](Parameters& p) { p.scale = 1.1e20; }), "1e20");
  contains(complaint([](Parameters& p) { p.degrees = -1000001; }), "1e6 degrees");
  EXPECT_EQ(complaint([](Parameters& p) { p.scale = 1e-20; }), "");
  EXPECT_EQ(complaint([](Parameters& p) { p.scale = 1e20; }), "");
  EXPECT_EQ(complaint([](Parameters& p) { p.degrees = 1e6; }), "");
  contains(complaint([](Parameters& p) { p.axis = {}; }), "no direction");
}

TEST(HandleMotion, MatrixErrors)
{
  const auto complaintOf = [](const std::array<double, 9>& linear, std::size_t place, double value)
  {
    std::array<double, 16> matrix = matrixOf(linear, { 0, 0, 0 });
    matrix[place] = value;
    return messageOf([&matrix] { HandleMotion::fromMatrix(matrix); });
  };
  constexpr std::array<double, 9> one{ 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  EXPECT_EQ(complaintOf(one, 0, 1.0), "");
  EXPECT_NE(complaintOf(one, 3, NotANumber).find("finite"), std::string::npos);
  EXPECT_NE(complaintOf(one, 14, 0.5).find("last row"), std::string::npos);
  EXPECT_NE(complaintOf(one, 15, 2.0).find("last row"), std::string::npos);
  EXPECT_NE(complaintOf(one, 0, -1.0).find("determinant"), std::string::npos);
  EXPECT_NE(complaintOf(one, 0, 0.0).find("determinant"), std::string::npos);
  EXPECT_NE(
    complaintOf({ 1, 2, 3, 4, 5, 6, 7, 8, 9 }, 15, 1.0).find("determinant"), std::string::npos);
  EXPECT_EQ(complaintOf({ 1e-120, 0, 0, 0, 1e-120, 0, 0, 0, 1e-120 }, 15, 1.0), "");
}

} // namespace smg::testing
