// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Distributed/PartOfMesh.h"
#include "Testing/Solver/EllipticTesting.h"
#include "Testing/Support/ArrayHandles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

// What processes say of a vertex that several of them have must be the same.

namespace smg::testing
{
namespace
{

bool isLast()
{
  return rankOfTest() == sizeOfTest() - 1;
}

/** A part of a surface or of a solid. */
MeshPart checkedPart(bool isSolid)
{
  const StreamMesh mesh = isSolid ? block(6, 5, 4) : patch(14, 12);
  return partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
}

/** The last of several processes sees this failure of the work, and with it all; one has no other
 * to disagree with. */
void expectDifference(const std::string& what, const std::function<void()>& work)
{
  const std::string message = messageOf(work);
  if (sizeOfTest() == 1)
  {
    EXPECT_EQ(message, "");
    return;
  }
  EXPECT_TRUE(contains(message, what + " of vertex ")) << message;
  EXPECT_TRUE(contains(message, " of the stream at (")) << message;
  EXPECT_TRUE(contains(message, "differs between process " + std::to_string(sizeOfTest() - 1)))
    << message;
}

/** The message of a problem that the last process changes. */
void expectDifferent(const std::string& what, const std::function<void(ElementProblem&)>& change)
{
  for (const bool isSolid : { false, true })
  {
    const MeshPart part = checkedPart(isSolid);
    const StreamMesh own = meshOf(part);
    DistributedSolver solver(MPI_COMM_WORLD, part);
    ElementProblem problem(own);
    problem.DirichletConditions.push_back(
      { below(0, 0.6), columnsOf(1, [](const ElementProblem::Point& p, int) { return p[1]; }) });
    problem.VertexSource = columnsOf(1, [](const ElementProblem::Point& p, int) { return p[0]; });
    problem.VertexScreening = [](const ElementProblem::Point&) { return 0.5; };
    EXPECT_EQ(messageOf([&] { solver.solve(problem); }), "");
    if (isLast())
    {
      change(problem);
    }
    expectDifference(what, [&] { solver.solve(problem); });
  }
}

} // namespace

TEST(CheckShared, Positions)
{
  for (const bool isSolid : { false, true })
  {
    MeshPart part = checkedPart(isSolid);
    if (isLast())
    {
      part.block.positions.front() += 1e-4;
    }
    expectDifference("the position", [&] { const DistributedSolver solver(MPI_COMM_WORLD, part); });
  }
}

TEST(CheckShared, PositionsMayBeRounded)
{
  MeshPart part = checkedPart(true);
  for (double& x : part.block.positions)
  {
    x = isLast() ? static_cast<double>(static_cast<float>(x)) : x;
  }
  EXPECT_EQ(messageOf([&] { const DistributedSolver solver(MPI_COMM_WORLD, part); }), "");
}

TEST(CheckShared, WhatIsPrescribed)
{
  expectDifferent("whether the problem prescribes the value", [](ElementProblem& problem)
    { problem.DirichletConditions[0].where = [](const ElementProblem::Point&) { return true; }; });
}

TEST(CheckShared, PrescribedValues)
{
  const auto everywhere = [](const ElementProblem::Point&) { return true; };
  const MeshPart part = checkedPart(false);
  const StreamMesh own = meshOf(part);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  ElementProblem problem(own);
  problem.DirichletConditions.push_back(
    { everywhere, columnsOf(1, [](const ElementProblem::Point& p, int)
                    { return p[1] + (isLast() ? 1e-3 : 0.0); }) });
  expectDifference("the prescribed value", [&] { solver.solve(problem); });
}

TEST(CheckShared, Sources)
{
  expectDifferent("the source",
    [](ElementProblem& problem)
    {
      problem.VertexSource =
        columnsOf(1, [](const ElementProblem::Point& p, int) { return p[0] + 1.0; });
    });
}

TEST(CheckShared, Screening)
{
  expectDifferent("the screening", [](ElementProblem& problem)
    { problem.VertexScreening = [](const ElementProblem::Point&) { return 0.75; }; });
}

TEST(CheckShared, InitialValuesAreThoseOfTheOwner)
{
  const MeshPart part = checkedPart(false);
  const StreamMesh own = meshOf(part);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  ElementProblem problem(own);
  problem.VertexScreening = [](const ElementProblem::Point&) { return 0.5; };
  problem.Initial = columnsOf(1, [](const ElementProblem::Point&, int) { return rankOfTest(); });
  EXPECT_TRUE(solver.solve(problem).report.converged);
}

TEST(CheckShared, Handles)
{
  const MeshPart part = checkedPart(true);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  const auto expect = [&](const std::string& what, const std::function<void(ArrayHandles&)>& change)
  {
    ArrayHandles handles(static_cast<std::int64_t>(part.ids.size()));
    std::ranges::fill(handles.Values.mask, std::uint8_t(1));
    handles.Values.target = part.block.positions;
    if (isLast())
    {
      change(handles);
    }
    expectDifference(what, [&] { solver.deform(handles); });
  };
  expect("whether the problem prescribes the value",
    [](ArrayHandles& handles)
    {
      std::ranges::fill(handles.Values.mask, std::uint8_t(0));
      handles.Values.mask.back() = 1;
    });
  expect(
    "the target that a handle gives", [](ArrayHandles& handles) { handles.Values.target[0] += 1; });
  expect("the prescribed value", [](ArrayHandles& handles) { handles.Values.rotation[1] = 0.5; });
}

} // namespace smg::testing
