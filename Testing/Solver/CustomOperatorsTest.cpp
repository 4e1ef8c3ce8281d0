// SPDX-License-Identifier: BSD-3-Clause
#include "Examples/CustomOperators/cxx/PaperOperators.h"
#include "Solver/Multigrid/Extended.h"
#include "Solver/Multigrid/RowOperators.h"
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/Combinations.h"
#include "smg/SolveWith.h"

#include <gtest/gtest.h>

#include <map>

// User-defined operator sets.

namespace smg::testing
{
namespace
{

/** Successive over-relaxation. */
struct OverRelaxation
{
  static constexpr double Factor = 1.2;

  template <bool LowerOnly, class Vectors, class Real>
  static void sweep(const auto& header, const auto& rows, BlockRange nodes, std::int64_t stride,
    Real* x, const Real* b)
  {
    for (std::int64_t k = nodes.begin; k < nodes.end; ++k)
    {
      const auto sum = neighbourSum<LowerOnly, Vectors>(header, rows, k, stride, x);
      const auto solved =
        (Vectors::load(b + k * stride) + sum) * static_cast<Real>(1.0 / rows.diagonal[k]);
      typename Vectors::Vector old{};
      if (!LowerOnly)
      {
        old = Vectors::load(x + k * stride);
      }
      Vectors::store(x + k * stride, old + static_cast<Real>(Factor) * (solved - old));
    }
  }
};

/** Extended with another relaxation. */
struct Custom : Extended
{
  static constexpr const char* name = "custom";
  using Relaxation = OverRelaxation;
  static Custom forCells(CellType type) { return { Extended::forCells(type) }; }
};

struct WithoutSweep
{
};
struct OnlyInDouble
{
  template <bool LowerOnly, class Vectors>
  static void sweep(const auto&, const auto&, BlockRange, std::int64_t, double*, const double*)
  {
  }
};
struct BadRelaxation : Extended
{
  using Relaxation = OnlyInDouble;
  static BadRelaxation forCells(CellType) { return {}; }
};

/** Direct interpolation from a maximal independent set of strong neighbours. */
template <class Own>
struct DirectRows : RowOperators<Own>
{
  bool isCPoint(const FineRow& row) const
  {
    return !row.empty() &&
           (row.isStiff() ||
             std::ranges::none_of(row.neighbours(), [&](const FineRow::Neighbour& other)
               { return other.isCoarse && other.weight >= 0.25F * row.strongest(); }));
  }
  void weightsOf(const FineRow& row, InterpolationWeights& P) const
  {
    double coarse = 0.0;
    for (const FineRow::Neighbour& other : row.neighbours())
    {
      coarse += other.isCoarse ? other.weight : 0.0F;
    }
    for (const FineRow::Neighbour& other : row.neighbours())
    {
      if (other.isCoarse && coarse > 0.0)
      {
        P.append(other.coarse, other.weight / (coarse + row.rowSum()));
      }
    }
  }
};

struct Direct : DirectRows<Direct>
{
  static constexpr const char* name = "direct";
};

/** All four operators of its own: the same coarse points and interpolation, the plain Galerkin
 * product by maps, nothing removed from it, over-relaxation. */
struct AllOwn : DirectRows<AllOwn>
{
  static constexpr const char* name = "all-own";
  using Relaxation = OverRelaxation;
  using Row = std::map<std::int64_t, double>;

  void productAP(CoarseningData& data, std::int64_t i) const
  {
    const std::int64_t near = data.interpolatedCoarse;
    Row row;
    double sum = data.fine.rowSum(i) * data.rowQuanta[i];
    const auto add = [&](std::int64_t node, double factor)
    {
      const InterpolationEntry* entries = data.interpolation.row(node);
      for (std::int64_t e = 0; e < data.interpolation.size(node); ++e)
      {
        row[near + entries[e].offset(near)] += factor * entries[e].weight();
      }
    };
    if (data.interpolation.size(i) > 0)
    {
      add(i, data.patches.diagonal(i));
      for (const RowEntry& entry : data.fine.row(i))
      {
        const std::int64_t j = i + entry.delta();
        add(j, -entry.weight());
        sum += double(entry.weight()) * (data.rowQuanta[i] - data.rowQuanta[j]);
      }
    }
    CoarseEntry* out = data.product.open(static_cast<std::int64_t>(row.size()));
    for (const auto& [c, value] : row)
    {
      *out++ = { static_cast<CoarseIndex>(c), static_cast<float>(value) };
    }
    data.product.close(static_cast<std::int64_t>(row.size()));
    data.productSum[i] = row.empty() ? 0.0F : static_cast<float>(sum / Quanta);
  }

  void productPtAP(CoarseningData& data, std::int64_t c) const
  {
    Row row;
    double rowSum = 0.0;
    for (ChildLink link = data.firstChild[c]; !link.none();)
    {
      const std::int64_t fine = link.row(data.finePoint[c]);
      const InterpolationEntry& entry = data.interpolation.row(fine)[link.slot()];
      const CoarseEntry* product = data.product.row(fine);
      for (std::int64_t e = 0; e < data.product.size(fine); ++e)
      {
        row[product[e].offset(c)] += double(entry.weight()) * product[e].value();
      }
      rowSum += double(entry.quanta()) / Quanta * data.productSum[fine];
      link = entry.next;
    }
    row.erase(0);
    CoarseEntry* out = data.gathered.open(static_cast<std::int64_t>(row.size()));
    std::int32_t lower = 0;
    float strongest = 0.0F, least = 0.0F;
    double sum = rowSum;
    for (const auto& [distance, value] : row)
    {
      const auto weight = static_cast<float>(-value);
      *out++ = { static_cast<CoarseIndex>(c + distance), weight };
      lower += distance < 0 ? 1 : 0;
      strongest = std::max(strongest, weight);
      least = std::min(least, weight);
      sum += weight;
    }
    const bool isSliver = data.stiff(least);
    data.gathered.close({ static_cast<std::int64_t>(row.size()), rowSum,
      static_cast<float>(nonZeroDiagonal(sum)), { strongest, isSliver }, lower, true });
  }

  void sparsify(CoarseningData& data, std::int64_t c) const { Sparsification{ 0.0F }(data, c); }
};

static_assert(OperatorSet<Extended> && OperatorSet<Custom>);
static_assert(OperatorSet<Direct> && canRunApart<Direct> && OperatorSet<AllOwn>);
static_assert(canRunApart<PaperOperators> && canRunApart<FullPaperOperators>);
static_assert(Relaxation<OverRelaxation> && Relaxation<GaussSeidel>);
static_assert(!Relaxation<WithoutSweep> && !Relaxation<OnlyInDouble>);
static_assert(!OperatorSet<BadRelaxation> && !OperatorSet<GaussSeidel>);

template <OperatorSet Operators>
Solved solveWithSet(const StreamMesh& mesh, Problem& problem, const SolveOptions& options)
{
  MemorySource source(mesh);
  const std::unique_ptr<Solution> solution = solveWith<Operators>(source, problem, options);
  return { valuesOf(*solution), solution->report() };
}

/** The target of an edge: turned about z, the more the higher its middle is. */
void twist(const double* p, const double* q, double* target)
{
  const double angle = 0.7 * (p[2] + q[2]);
  target[0] = std::cos(angle) * (p[0] - q[0]) - std::sin(angle) * (p[1] - q[1]);
  target[1] = std::sin(angle) * (p[0] - q[0]) + std::cos(angle) * (p[1] - q[1]);
  target[2] = p[2] - q[2];
}

std::vector<std::pair<StreamMesh, ArrayProblem>> tasks()
{
  std::vector<std::pair<StreamMesh, ArrayProblem>> list;
  const StreamMesh surface = toStream(shuffled(torus(50, 32, 0.3)));
  list.emplace_back(surface, heldEnds(surface, 3, Weights::Clamped));
  list.emplace_back(surface, heldEnds(surface, 1, Weights::Uniform));
  // The positions of a deformation: three columns, with a target for each edge, here twisted.
  list.emplace_back(surface, fixedEnds(surface));
  list.back().second.Target = twist;
  const StreamMesh solid = toStream(shuffled(tetBox(9, 8, 10, 0.1)));
  list.emplace_back(solid, heldEnds(solid, 1, Weights::Clamped));
  // Weights of either sign.
  list.emplace_back(surface, heldEnds(surface, 1, Weights::Cotangent));
  list.emplace_back(solid, heldEnds(solid, 3, Weights::Cotangent));
  return list;
}

} // namespace

TEST(CustomOperators, TheDefaultSetIsThatOfSolve)
{
  auto [mesh, problem] = tasks()[0];
  const Solved expected = solveMesh(mesh, problem);
  EXPECT_TRUE(sameBits(solveWithSet<Extended>(mesh, problem, {}).values, expected.values));
}

TEST(CustomOperators, AnotherRelaxationConvergesToTheDirectSolution)
{
  for (auto& [mesh, problem] : tasks())
  {
    const Solved solved = solveWithSet<Custom>(mesh, problem, accurate());
    EXPECT_TRUE(solved.report.converged);
    EXPECT_LE(solved.report.cycles, 25);
    EXPECT_LT(relativeError(solved.values, solveDirectly(mesh, problem)), 1e-7);
    // It differs from the default method.
    const Solved usual = solveWithSet<Extended>(mesh, problem, accurate());
    EXPECT_NE(solved.report.residuals, usual.report.residuals);
  }
}

TEST(CustomOperators, ParametersAreValues)
{
  for (auto& [mesh, problem] : tasks())
  {
    MemorySource source(mesh);
    const std::unique_ptr<Solution> solution =
      solveWith(compiled(Extended::forFewCycles(mesh.cellType)), source, problem, accurate());
    EXPECT_LT(relativeError(valuesOf(*solution), solveDirectly(mesh, problem)), 1e-7);
    const Solved usual = solveWithSet<Extended>(mesh, problem, accurate());
    EXPECT_LE(solution->report().cycles, usual.report.cycles);
    EXPECT_NE(solution->report().residuals, usual.report.residuals);
  }
}

TEST(CustomOperators, OptionsAndProblemsAreCheckedAsBySolve)
{
  auto [mesh, problem] = tasks()[1];
  SolveOptions options;
  options.operators = "not looked at";
  EXPECT_EQ(messageOf([&] { solveWithSet<Custom>(mesh, problem, options); }), "");
  EXPECT_NE(messageOf([&] { solveMesh(mesh, problem, options); }).find("no operator set"),
    std::string::npos);
  options.sweeps = 0;
  EXPECT_NE(messageOf([&] { solveWithSet<Custom>(mesh, problem, options); }).find("sweeps"),
    std::string::npos);
  problem.Screening = -1;
  EXPECT_NE(messageOf([&] { solveWithSet<Custom>(mesh, problem, {}); }).find("screening"),
    std::string::npos);
}

template <OperatorSet Operators>
class OwnSets : public ::testing::Test
{
};
using AllOwnSets = ::testing::Types<Custom, Direct, AllOwn, PaperOperators, FullPaperOperators>;
TYPED_TEST_SUITE(OwnSets, AllOwnSets);

TYPED_TEST(OwnSets, ConvergeToTheDirectSolution)
{
  for (auto& [mesh, problem] : tasks())
  {
    const Solved solved = solveWithSet<TypeParam>(mesh, problem, accurate());
    EXPECT_TRUE(solved.report.converged);
    EXPECT_LE(solved.report.cycles, 40);
    EXPECT_GE(solved.report.levels.size(), 2u);
    EXPECT_LT(relativeError(solved.values, solveDirectly(mesh, problem)), 1e-7);
  }
}

TYPED_TEST(OwnSets, StreamingEqualsInCoreBitForBit)
{
  SolveOptions options;
  options.tolerance = 1e-12;
  options.maxCycles = 3;
  Combinations chosen;
  for (auto& [mesh, problem] : tasks())
  {
    options.inCore = true;
    const Solved expected = solveWithSet<TypeParam>(mesh, problem, options);
    options.inCore = false;
    for (const std::int64_t coreNodes : { 0, 300 })
    {
      for (const std::int64_t blockNodes : { 64, 1000, 1 << 20 })
      {
        for (const int threads : { 1, 2, 4 })
        {
          if (!chosen.next())
          {
            continue;
          }
          options.coreNodes = coreNodes;
          options.blockNodes = blockNodes;
          options.threads = threads;
          const Solved solved = solveWithSet<TypeParam>(mesh, problem, options);
          EXPECT_TRUE(sameBits(solved.values, expected.values))
            << coreNodes << " core nodes, blocks of " << blockNodes << ", " << threads
            << " threads";
          EXPECT_EQ(solved.report.residuals, expected.report.residuals);
        }
      }
    }
  }
}

} // namespace smg::testing
