// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/ComposeDescriptions.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>

namespace smg::testing
{

TEST(DescriptionText, TellsOwnersOfAColumnApart)
{
  using Owner = DataValue::Owner;
  std::set<std::string> texts;
  for (const Owner owner : { Owner::Usual, Owner::Vertices, Owner::Cells })
  {
    ProblemDescription problem;
    problem.source = DataValue("a", owner);
    texts.insert(textOf(problem));
  }
  EXPECT_EQ(texts.size(), 3U);
}

TEST(DescriptionText, IsAnotherOneForEachChange)
{
  using Change = std::function<void(ProblemDescription&)>;
  const Region::Sphere sphere{ { 0, 0, 0 }, 1 };
  const Change changes[] = {
    [](auto&) {},
    [](auto& p) { p.weights = Weights::Uniform; },
    [](auto& p) { p.columns = 2; },
    [](auto& p) { p.conductivity = 1.0; },
    [](auto& p) {
      p.conductivity = DataValue{ 1.0, 2.0, 3.0 };
    },
    [](auto& p) { p.screening = 1.0; },
    [](auto& p) { p.source = 1.0; },
    [](auto& p) { p.source = 1.0 + 1e-15; },
    [](auto& p) { p.source = "1"; },
    [](auto& p) { p.source = Position{}; },
    [](auto& p) { p.field = "q"; },
    [](auto& p) { p.initial = 1.0; },
    [](auto& p) {
      p.dirichlet = { { Everywhere{}, 1.0 } };
    },
    [](auto& p) {
      p.dirichlet = { { OnBoundary{}, 1.0 } };
    },
    [&](auto& p) {
      p.dirichlet = { { sphere, 1.0 } };
    },
    [&](auto& p) {
      p.dirichlet = { { Region::Sphere{ { 0, 0, 0 }, 2 }, 1.0 } };
    },
    [&](auto& p) {
      p.dirichlet = { { sphere, 1.0 }, { sphere, 1.0 } };
    },
    [](auto& p) {
      p.dirichlet = { { Region::Box{ { 0, 0, 0 }, { 1, 1, 1 } }, 1.0 } };
    },
    [](auto& p) {
      p.dirichlet = { { Region::HalfSpace{ { 1, 0, 0 }, 1 }, 1.0 } };
    },
    [](auto& p) {
      p.dirichlet = { { Region::Vertices{ { 1, 2 } }, 1.0 } };
    },
    [](auto& p) {
      p.dirichlet = { { Region::Vertices{ { 1 } }, 1.0 } };
    },
    [](auto& p) {
      p.dirichlet = { { ColumnTag{ "a", 1 }, 1.0 } };
    },
    [](auto& p) {
      p.dirichlet = { { ColumnTag{ "b", 1 }, 1.0 } };
    },
    [](auto& p) {
      p.dirichlet = { { ColumnMask{ "a" }, 1.0 } };
    },
    [](auto& p) {
      p.dirichlet = { { NearestVertices{ { { 0, 0, 1 } } }, 1.0 } };
    },
    [](auto& p) {
      p.flux = { { Everywhere{}, 1.0 } };
    },
    [](auto& p) {
      p.robin = { { Everywhere{}, 1.0, 2.0 } };
    },
    [](auto& p) {
      p.robin = { { Everywhere{}, 2.0, 1.0 } };
    },
    [](auto& p) {
      p.soft = { { Everywhere{}, 1.0, 2.0 } };
    },
    [](auto& p) { p.gradientOutput = true; },
    [](auto& p) { p.fluxOutput = true; },
  };
  std::set<std::string> texts;
  for (const Change& change : changes)
  {
    ProblemDescription problem, same;
    change(problem);
    change(same);
    EXPECT_TRUE(texts.insert(textOf(problem)).second) << textOf(problem);
    EXPECT_EQ(textOf(problem), textOf(same));
  }
}

TEST(DescriptionText, TellsResultsApart)
{
  ProblemDescription plain, gradients, one, several;
  gradients.vertexGradientOutput = true;
  one.integrals = { "chip" };
  several.integrals = { "*", "chip" };
  const std::set<std::string> texts{ textOf(plain), textOf(gradients), textOf(one),
    textOf(several) };
  EXPECT_EQ(texts.size(), 4U);
}

} // namespace smg::testing
