// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Distributed/PartOfMesh.h"
#include "Testing/Solver/DeformationTesting.h"
#include "Testing/Support/ArrayProblem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

// On any number of processes, a deformation is that of the streaming engine.

namespace smg::testing
{
namespace
{

/** Of the range of the positions. */
constexpr double MaxDifference = 1e-6;

/** Two surfaces and two solids; beside each, at large x, a component without held vertices. */
std::vector<StreamMesh> meshesToDeform()
{
  const auto with = [](const IndexedTestMesh& mesh, const IndexedTestMesh& free) {
    return toStream(shuffled(disjointUnion(mesh, free, { 100.1, 0.2, 1.0 / 3.0 })));
  };
  const IndexedTestMesh ball = sphere(2), box = tetBox(3, 2, 2, 0.1);
  return { with(tube(16, 40, 9.0, 0.2), ball), with(bumpy(torus(40, 22, 0.3), 0.2), ball),
    with(tetBox(4, 5, 12, 0.15), box), with(tetBox(9, 6, 6), box) };
}

bool isFree(const Eigen::Vector3d& p)
{
  return p.x() > 50;
}

/** Rotation, scale and translation at the upper end in z; several handles hold its middle. */
ArrayHandles handlesOf(const StreamMesh& mesh)
{
  double low = 1e9, high = -1e9;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const Eigen::Vector3d point = positionsOf(mesh).row(v);
    low = isFree(point) ? low : std::min(low, point.z());
    high = isFree(point) ? high : std::max(high, point.z());
  }
  const double size = high - low;
  const auto between = [=](double from, double to)
  {
    return [=](const Eigen::Vector3d& p)
    { return !isFree(p) && p.z() >= low + from * size && p.z() <= low + to * size; };
  };
  ArrayHandles handles(mesh.vertices());
  handles.hold(mesh, between(0.0, 0.1), turn(-20.0, { 0, 0, 1 }));
  handles.hold(mesh, between(0.85, 1.0), turn(10.0, { 1, 0, 0 }));
  handles.hold(mesh, between(0.9, 1.0), anyMotion());
  return handles;
}

/** Those at the vertices of a part. */
ArrayHandles handlesOf(const ArrayHandles& whole, const MeshPart& part)
{
  ArrayHandles some(static_cast<std::int64_t>(part.ids.size()));
  const auto pick = [&](const auto& from, auto& to, std::size_t lanes)
  {
    for (std::size_t k = 0; k < part.ids.size(); ++k)
    {
      std::copy_n(from.begin() + part.ids[k] * static_cast<std::int64_t>(lanes), lanes,
        to.begin() + static_cast<std::int64_t>(k * lanes));
    }
  };
  pick(whole.Values.mask, some.Values.mask, 1);
  pick(whole.Values.target, some.Values.target, 3);
  pick(whole.Values.rotation, some.Values.rotation, 3);
  pick(whole.Values.logScale, some.Values.logScale, 1);
  return some;
}

struct Deformations
{
  Eigen::MatrixXd distributed, streamed; ///< on process 0
  Report report, ofStream;
};

/** Deforms the parts, and on process 0 the mesh with the streaming engine. */
Deformations deformBoth(
  const StreamMesh& mesh, const std::vector<std::int64_t>& cuts, Weights weights)
{
  Deformations both;
  ArrayHandles whole = handlesOf(mesh);
  const MeshPart part = partOf(mesh, cuts);
  ArrayHandles handles = handlesOf(whole, part);
  DistributedSolver solver(MPI_COMM_WORLD, part);
  DistributedOptions options;
  options.tolerance = 1e-10;
  const DistributedSolution solution = solver.deform(handles, weights, options);
  both.report = solution.report;
  both.distributed = wholeSolution(solver, solution);
  if (rankOfTest() == 0)
  {
    Solved streamed = deformMesh(mesh, whole, byTolerance(1e-10, weights));
    both.streamed = std::move(streamed.values);
    both.ofStream = std::move(streamed.report);
  }
  return both;
}

double differenceOf(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  return (a - b).cwiseAbs().maxCoeff() / (b.maxCoeff() - b.minCoeff());
}

/** Expects the positions and the reports to agree. */
void expectEqualDeformations(const Deformations& both)
{
  const Report& a = both.report;
  EXPECT_TRUE(a.converged);
  EXPECT_EQ(a.distributed->setups, 1);
  EXPECT_EQ(a.distributed->iterations.size(), 7U);
  ASSERT_EQ(a.steps.size(), 2U);
  EXPECT_EQ(a.steps[0].name, "rotation");
  EXPECT_EQ(a.steps[1].name, "position");
  EXPECT_EQ(a.steps[0].cycles + a.steps[1].cycles, a.cycles);
  if (rankOfTest() != 0)
  {
    return;
  }
  EXPECT_LT(differenceOf(both.distributed, both.streamed), MaxDifference);
  const Report& b = both.ofStream;
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.prescribed, b.prescribed);
  EXPECT_GT(a.shared, 0);
  EXPECT_EQ(a.shared, b.shared);
  EXPECT_EQ(a.free_components, 1);
  EXPECT_EQ(a.components, b.components);
  EXPECT_EQ(a.levels.front().nonzeros, b.levels.front().nonzeros);
  EXPECT_EQ(a.notes, b.notes);
}

/** The differenceOf of each vertex from where it was, and from its target if it is held. */
void expectExact(const StreamMesh& mesh, const Eigen::MatrixXd& positions)
{
  const ArrayHandles handles = handlesOf(mesh);
  std::int64_t held = 0, free = 0;
  for (std::int64_t v = 0; rankOfTest() == 0 && v < mesh.vertices(); ++v)
  {
    const Eigen::Vector3d rest = positionsOf(mesh).row(v);
    const bool isHeld = handles.Values.mask[v] > 0;
    const auto target = Eigen::Vector3d::Map(&handles.Values.target[3 * v]);
    if (isHeld || isFree(rest))
    {
      ++(isHeld ? held : free);
      ASSERT_EQ(Eigen::Vector3d(positions.row(v)), isHeld ? Eigen::Vector3d(target) : rest);
    }
  }
  EXPECT_TRUE(rankOfTest() != 0 || (held > 0 && free > 0));
}

} // namespace

TEST(DistributedDeform, AgreesWithTheStreamingEngine)
{
  for (const StreamMesh& mesh : meshesToDeform())
  {
    for (const Weights weights : { Weights::Clamped, Weights::Cotangent, Weights::Uniform })
    {
      expectEqualDeformations(deformBoth(mesh, evenCuts(mesh.cells(), sizeOfTest()), weights));
    }
  }
}

TEST(DistributedDeform, ProcessesMayLackCells)
{
  for (const StreamMesh& mesh : { meshesToDeform().front(), meshesToDeform().back() })
  {
    for (const int first : { 0, 1 })
    {
      expectEqualDeformations(
        deformBoth(mesh, cutsWithGaps(mesh.cells(), sizeOfTest(), first), Weights::Clamped));
    }
  }
}

TEST(DistributedDeform, HeldAndFreeComponentsAreExact)
{
  for (const StreamMesh& mesh : meshesToDeform())
  {
    const auto cuts = evenCuts(mesh.cells(), sizeOfTest());
    expectExact(mesh, deformBoth(mesh, cuts, Weights::Clamped).distributed);
  }
}

TEST(DistributedDeform, EdgeTargetsAreThoseOfTheStreamingEngine)
{
  for (const StreamMesh& mesh : { meshesToDeform().front(), meshesToDeform().back() })
  {
    const auto problemOf = [](const StreamMesh& on)
    {
      ArrayProblem problem = fixedEnds(on, 0.1);
      problem.Target = [](const double* p, const double* q, double* target)
      {
        target[0] = 2.0 * (p[1] - q[1]);
        target[1] = p[0] * p[0] - q[0] * q[0];
        target[2] = std::sin(p[2]) - std::sin(q[2]);
      };
      return problem;
    };
    const MeshPart part = partOf(mesh, evenCuts(mesh.cells(), sizeOfTest()));
    ArrayProblem whole = problemOf(mesh), problem = whole;
    problem.Prescribed.clear();
    problem.Value.clear();
    for (const std::int64_t id : part.ids)
    {
      problem.Prescribed.push_back(whole.Prescribed[id]);
      problem.Value.insert(
        problem.Value.end(), whole.Value.begin() + 3 * id, whole.Value.begin() + 3 * id + 3);
    }
    DistributedSolver solver(MPI_COMM_WORLD, part);
    DistributedOptions options;
    options.tolerance = 1e-10;
    const Eigen::MatrixXd values = wholeSolution(solver, solver.solve(problem, options));
    if (rankOfTest() == 0)
    {
      EXPECT_LT(
        differenceOf(values, solveMesh(mesh, whole, accurate(1e-10)).values), MaxDifference);
    }
  }
}

} // namespace smg::testing
