// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SolveTesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

// Weights of a problem, queried in batches of cells.

namespace smg::testing
{
namespace
{

/** A problem whose weights are a function of the cotangent weights. */
class Weighed : public ArrayProblem
{
public:
  using Weigh = std::function<void(CellBatch&)>;

  Weighed(ArrayProblem problem, Weigh weigh)
    : ArrayProblem(std::move(problem))
    , Function(std::move(weigh))
  {
    this->EdgeWeights = Weights::Clamped;
  }
  bool hasCells() const override { return true; }
  void cells(CellBatch& batch) override { this->Function(batch); }

private:
  Weigh Function;
};

/** Surfaces and solids with obtuse cells whose weights are below the floor. */
std::vector<StreamMesh> meshes()
{
  return { toStream(shuffled(torus(60, 40, 0.4))), toStream(shuffled(tetBox(9, 10, 11, 0.15))) };
}

/** A solve of a few cycles, out of core. */
Solved shortSolve(const StreamMesh& mesh, Problem& problem, std::int64_t blockCells = 1000)
{
  SolveOptions options;
  options.tolerance = 1e-12;
  options.maxCycles = 3;
  options.coreNodes = 200;
  return solveMesh(mesh, problem, options, blockCells);
}

/** The cotangent weights, from the points of a batch. */
void cotangent(CellBatch& batch)
{
  for (std::size_t c = 0; c < batch.cells(); ++c)
  {
    const double* points[4] = {};
    for (int k = 0; k < cornersOf(batch.type); ++k)
    {
      points[k] = batch.point(c, k);
    }
    const smg::CellWeights cell = smg::cellWeights(batch.type, points);
    EXPECT_EQ(batch.measure[c], cell.measure);
    std::copy_n(cell.weight, edgesOf(batch.type), batch.weightsOf(c).begin());
  }
}

Weighed::Weigh times(double factor)
{
  return [factor](CellBatch& batch)
  {
    for (double& weight : batch.weight)
    {
      weight *= factor;
    }
  };
}

/** The mean of coordinate `axis` over the corners of cell c. */
double middle(const CellBatch& batch, std::size_t c, int axis)
{
  double sum = 0.0;
  for (int k = 0; k < cornersOf(batch.type); ++k)
  {
    sum += batch.point(c, k)[axis];
  }
  return sum / cornersOf(batch.type);
}

/** The conductivity is 1 where coordinate `axis` is below `at`, and `beyond` above. */
Weighed::Weigh step(int axis, double at, double beyond)
{
  return [=](CellBatch& batch)
  {
    for (std::size_t c = 0; c < batch.cells(); ++c)
    {
      const double factor = middle(batch, c, axis) < at ? 1.0 : beyond;
      for (double& weight : batch.weightsOf(c))
      {
        weight *= factor;
      }
    }
  };
}

/** The solution of the step between u = 0 at 0 and u = 1 at `length`. */
double acrossStep(double x, double at, double beyond, double length)
{
  const double flux = 1.0 / (at + (length - at) / beyond);
  return x < at ? flux * x : 1.0 - flux * (length - x) / beyond;
}

} // namespace

TEST(OwnWeights, ByTheCotangentFormulaAreTheCotangentWeightsBitForBit)
{
  for (const StreamMesh& mesh : meshes())
  {
    ArrayProblem problem = heldEnds(mesh, 3, Weights::Clamped);
    problem.Screening = 0.1;
    const Solved expected = shortSolve(mesh, problem);
    EXPECT_GT(expected.report.clamped_weights, 10);
    for (const Weighed::Weigh& weigh : { Weighed::Weigh(cotangent), times(1.0) })
    {
      Weighed own(problem, weigh);
      const Solved solved = shortSolve(mesh, own);
      EXPECT_TRUE(sameBits(solved.values, expected.values));
      EXPECT_EQ(solved.report.residuals, expected.report.residuals);
      EXPECT_EQ(solved.report.clamped_weights, expected.report.clamped_weights);
    }
  }
}

TEST(OwnWeights, TheirScaleDoesNotMatterNotEvenToTheFloor)
{
  for (const StreamMesh& mesh : meshes())
  {
    ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
    const Solved expected = shortSolve(mesh, problem);
    for (const int power : { -30, -3, 30 })
    {
      Weighed own(problem, times(std::ldexp(1.0, power)));
      const Solved solved = shortSolve(mesh, own);
      EXPECT_TRUE(sameBits(solved.values, expected.values)) << "2^" << power;
      EXPECT_EQ(solved.report.clamped_weights, expected.report.clamped_weights);
    }
  }
}

TEST(OwnWeights, OfFiniteElementsScaleAlikeHoweverFlatTheCellsAre)
{
  for (StreamMesh mesh : meshes())
  {
    // One vertex of a cell is almost in the plane of the others.
    const std::int64_t* cell = &mesh.corners[cornersOf(mesh.cellType) * (mesh.cells() / 2)];
    for (int d = 0; d < 3; ++d)
    {
      mesh.positions[3 * cell[0] + d] =
        0.5 * mesh.positions[3 * cell[1] + d] + 0.5 * mesh.positions[3 * cell[2] + d] + 1e-8 * d;
    }
    ArrayProblem problem = heldEnds(mesh, 1, Weights::Cotangent);
    const Solved expected = shortSolve(mesh, problem);
    for (const int power : { -30, 0, 30 })
    {
      Weighed own(problem, times(std::ldexp(1.0, power)));
      own.EdgeWeights = Weights::Cotangent;
      EXPECT_TRUE(sameBits(shortSolve(mesh, own).values, expected.values)) << "2^" << power;
    }
    EXPECT_TRUE(hasNote(expected.report, "so flat"));
  }
}

TEST(OwnWeights, AreNotLookedAtWhereAllAreUniform)
{
  const StreamMesh mesh = meshes()[0];
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Uniform);
  Weighed own(problem, [](CellBatch& batch) { std::ranges::fill(batch.weight, -1e30); });
  own.EdgeWeights = Weights::Uniform;
  EXPECT_TRUE(sameBits(shortSolve(mesh, own).values, shortSolve(mesh, problem).values));
}

TEST(OwnWeights, OfOneHalfOnAClosedSurfaceAreUniform)
{
  const StreamMesh mesh = meshes()[0];
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Uniform);
  Weighed own(problem, [](CellBatch& batch) { std::ranges::fill(batch.weight, 0.5); });
  // Beside weights of finite elements they differ as conductivities do, and are summed up likewise.
  EXPECT_TRUE(shortSolve(mesh, own).values.isApprox(shortSolve(mesh, problem).values, 1e-12));
}

TEST(OwnWeights, AStepOfConductivityBreaksALinearFunctionOnAFlatMesh)
{
  const StreamMesh mesh = toStream(shuffled(grid(50, 41)));
  const double row = std::sqrt(0.75);
  const double at = 15 * row;
  const double length = 40 * row;
  for (const double beyond : { 1e-6, 0.01, 100.0, 1e6 })
  {
    ArrayProblem problem;
    Eigen::MatrixXd exact(mesh.vertices(), 1);
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      const double x = mesh.positions[3 * v];
      const double y = mesh.positions[3 * v + 1];
      exact(v) = acrossStep(y, at, beyond, length);
      const bool border = x < 1 || x > 48 || y < 0.1 || y > length - 0.1;
      problem.Prescribed.push_back(border);
      problem.Value.push_back(border ? exact(v) : 0.0);
    }
    Weighed own(problem, step(1, at, beyond));
    const Solved solved = solveMesh(mesh, own, accurate(1e-11));
    EXPECT_TRUE(solved.report.converged);
    EXPECT_LT(relativeError(solved.values, exact), 2e-8) << beyond;
  }
}

TEST(OwnWeights, AStepOfConductivityDividesTheDropAlongABar)
{
  const StreamMesh mesh = toStream(shuffled(tetBox(21, 7, 7)));
  const double at = 8;
  for (const double beyond : { 1e-5, 0.1, 1000.0 })
  {
    ArrayProblem problem;
    Eigen::MatrixXd exact(mesh.vertices(), 1);
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      const double x = mesh.positions[3 * v];
      exact(v) = acrossStep(x, at, beyond, 20);
      problem.Prescribed.push_back(x == 0 || x == 20);
      problem.Value.push_back(x == 20 ? 1.0 : 0.0);
    }
    Weighed own(problem, step(0, at, beyond));
    const Solved solved = solveMesh(mesh, own, accurate());
    EXPECT_TRUE(solved.report.converged);
    // Right angles have the weight 0, raised to the floor: 1e-4 of that of the edges along x.
    EXPECT_LT(relativeError(solved.values, exact), 1e-3) << beyond;
  }
}

TEST(OwnWeights, AtAStepTheFloorIsThatOfTheWeakerSide)
{
  // The edge between the cells has the weight 0 in the strong one, opposite to a right angle.
  MeshBlock block;
  block.positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 2, 0 };
  block.corners = { 0, 1, 2, 1, 3, 2 };
  block.finalized = 4;
  for (const double beyond : { 1.0, 1e-5 })
  {
    BlockSource source(CellType::Triangle, { block });
    Weighed own(ArrayProblem(), step(0, 0.5, beyond));
    EXPECT_EQ(solveMesh(source, own, {}).report.clamped_weights, 0) << beyond;
  }
}

TEST(OwnWeights, DoNotDependOnBlocks)
{
  for (const StreamMesh& mesh : meshes())
  {
    Weighed own(heldEnds(mesh, 1, Weights::Clamped), step(0, 1.0, 30.0));
    SolveOptions inCore;
    inCore.tolerance = 1e-12;
    inCore.maxCycles = 3;
    inCore.inCore = true;
    const Solved expected = solveMesh(mesh, own, inCore);
    for (const std::int64_t blockCells : { 1, 17, 255, 256, 257, 100000 })
    {
      EXPECT_TRUE(sameBits(shortSolve(mesh, own, blockCells).values, expected.values))
        << "blocks of " << blockCells << " cells";
    }
  }
}

TEST(OwnWeights, AreAskedForOnceForEachCellInStreamOrder)
{
  for (StreamMesh mesh : meshes())
  {
    std::vector<double> numbers(mesh.cells());
    std::iota(numbers.begin(), numbers.end(), 0.0);
    mesh.cellColumns.push_back(makeColumn<double>("Number", numbers));
    std::int64_t next = 0;
    Weighed own(heldEnds(mesh, 1, Weights::Clamped),
      [&](CellBatch& batch)
      {
        const auto size = static_cast<std::size_t>(cornersOf(mesh.cellType));
        ASSERT_EQ(batch.type, mesh.cellType);
        ASSERT_EQ(batch.corners.size(), size * batch.cells());
        for (std::size_t c = 0; c < batch.cells(); ++c, ++next)
        {
          EXPECT_EQ(batch.block.cellColumns[0].value(batch.first + c), double(next));
          for (std::size_t k = 0; k < size; ++k)
          {
            const std::int64_t v = mesh.corners[size * next + k];
            EXPECT_EQ(batch.corners[size * c + k], v);
            EXPECT_TRUE(std::equal(
              batch.point(c, int(k)), batch.point(c, int(k)) + 3, mesh.positions.begin() + 3 * v));
          }
        }
      });
    shortSolve(mesh, own, 600);
    EXPECT_EQ(next, mesh.cells());
  }
}

TEST(OwnWeights, ACellOfNoMeasureHasNoWeight)
{
  for (StreamMesh mesh : meshes())
  {
    ArrayProblem problem = heldEnds(mesh, 1, Weights::Clamped);
    Weighed own(problem,
      [](CellBatch& batch)
      {
        for (std::size_t c = 0; c < batch.cells(); ++c)
        {
          batch.measure[c] = middle(batch, c, 1) < 0.5 ? 0.0 : batch.measure[c];
        }
      });
    const Solved solved = shortSolve(mesh, own);
    std::vector<std::uint8_t> flags;
    const auto size = static_cast<std::size_t>(cornersOf(mesh.cellType));
    for (std::size_t c = 0; c < mesh.corners.size(); c += size)
    {
      double sum = 0.0;
      for (std::size_t k = 0; k < size; ++k)
      {
        sum += mesh.positions[3 * mesh.corners[c + k] + 1];
      }
      flags.push_back(sum / double(size) < 0.5 ? DegenerateCell : 0);
    }
    mesh.cellColumns.push_back(makeColumn<std::uint8_t>(CellFlagsName, flags));
    const Solved flagged = shortSolve(mesh, problem);
    EXPECT_TRUE(sameBits(solved.values, flagged.values));
    EXPECT_GT(solved.report.degenerate_cells, 100);
    EXPECT_EQ(solved.report.degenerate_cells, flagged.report.degenerate_cells);
    EXPECT_EQ(solved.report.held, flagged.report.held);
  }
}

TEST(OwnWeights, ThatAreNotValidAreAnError)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const StreamMesh& mesh : meshes())
  {
    const auto errorOf = [&mesh](const Weighed::Weigh& weigh)
    {
      Weighed own(heldEnds(mesh, 1, Weights::Clamped), weigh);
      return messageOf([&] { shortSolve(mesh, own, 300); });
    };
    // Only cell 700 of the stream is invalid.
    const auto errorOfCell = [&](const std::function<void(CellBatch&, std::size_t)>& spoil)
    {
      return errorOf(
        [&spoil](CellBatch& batch)
        {
          const auto first = batch.block.firstCell + static_cast<std::int64_t>(batch.first);
          if (first <= 700 && 700 < first + static_cast<std::int64_t>(batch.cells()))
          {
            spoil(batch, static_cast<std::size_t>(700 - first));
          }
        });
    };
    for (const double bad : { nan, infinite, -infinite })
    {
      EXPECT_NE(errorOfCell([bad](CellBatch& batch, std::size_t c) { batch.weightsOf(c)[1] = bad; })
                  .find("cell 700 "),
        std::string::npos);
      EXPECT_NE(errorOfCell([bad](CellBatch& batch, std::size_t c) { batch.measure[c] = bad; })
                  .find("cell 700 "),
        std::string::npos);
    }
    EXPECT_NE(errorOfCell([](CellBatch& batch, std::size_t c) { batch.measure[c] = -1; }), "");
    for (const double bad : { nan, infinite, -1.0 })
    {
      EXPECT_NE(errorOfCell([bad](CellBatch& batch, std::size_t c) { batch.screening[c] = bad; })
                  .find("screening of cell 700 "),
        std::string::npos);
    }
    for (const double bad : { nan, infinite })
    {
      EXPECT_NE(errorOfCell([bad](CellBatch& batch, std::size_t c) { batch.source[c] = bad; })
                  .find("cell 700 "),
        std::string::npos);
      EXPECT_NE(
        errorOfCell([bad](CellBatch& batch, std::size_t c) { batch.field[3 * c + 2] = bad; })
          .find("cell 700 "),
        std::string::npos);
    }
    EXPECT_NE(errorOfCell([](CellBatch& batch, std::size_t c)
                { std::ranges::fill(batch.weightsOf(c), -1.0); }),
      "");
    EXPECT_NE(errorOfCell(
                [](CellBatch& batch, std::size_t c) { std::ranges::fill(batch.weightsOf(c), 0); }),
      "");
    EXPECT_EQ(errorOfCell([](CellBatch& batch, std::size_t c) { batch.weightsOf(c)[0] = -1; }), "");
    for (const double factor : { 1e-30, 1e30, 1e300 })
    {
      EXPECT_NE(errorOf(times(factor)).find("outside 1e-20 to 1e20"), std::string::npos);
    }
  }
}

} // namespace smg::testing
