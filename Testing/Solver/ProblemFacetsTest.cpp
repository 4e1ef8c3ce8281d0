// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/ProblemFacets.h"
#include "Solver/Assembly/Facets.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/NotNumbers.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace smg::testing
{
namespace
{

using Facet = std::vector<std::int64_t>;

/** A problem with data on every facet: one number per corner. */
class Everywhere : public Problem
{
public:
  std::function<void(FacetBatch&)> spoil;

  int columns() const override { return 2; }
  bool hasFacets() const override { return true; }
  ConditionCounts conditionCounts() const override { return { 0, 1, 1 }; }
  void conditions(const MeshBlock& /*block*/, VertexConditions& /*conditions*/) override {}
  void facets(FacetBatch& batch) override
  {
    const auto corners = static_cast<std::size_t>(cornersOf(batch.type));
    for (std::size_t facet = 0; facet < batch.flux.size(); ++facet)
    {
      EXPECT_EQ(batch.flux[facet], -1);
      batch.flux[facet] = 0;
      batch.robin[facet] = facet % 2 == 0 ? 0 : -1;
      std::size_t place = facet * (corners - 1);
      for (std::size_t k = 0; k < corners; ++k)
      {
        if (k != facet % corners)
        {
          const auto vertex = static_cast<double>(batch.corners[facet / corners * corners + k]);
          batch.fluxValue[2 * place] = vertex;
          batch.fluxValue[2 * place + 1] = -vertex;
          batch.coefficient[place] = 10.0 * vertex;
          batch.ambient[2 * place] = vertex + 0.5;
          ++place;
        }
      }
    }
    if (this->spoil)
    {
      this->spoil(batch);
    }
  }
};

/** The boundary facets, with the vertices of the blocks final as early as possible. */
std::vector<Facet> boundaryOf(
  const StreamMesh& mesh, std::int64_t blockCells, Problem& problem, Pool& pool)
{
  OpenVertices vertices(pool, problem);
  ProblemFacets facets(pool, problem, mesh.cellType, vertices);
  const int count = BoundaryFacet::cornersOf(mesh.cellType);
  std::vector<Facet> found;
  std::int64_t final = 0;
  std::int64_t end = 0;
  const auto take = [&](std::int64_t to)
  {
    for (; final < to; ++final)
    {
      facets.take(final,
        [&](const BoundaryFacet& facet, double /*area*/)
        {
          found.emplace_back(facet.corners, facet.corners + count);
          for (int c = 0; c < count && facet.flux >= 0; ++c)
          {
            const auto vertex = static_cast<double>(facet.corners[c]);
            EXPECT_EQ(facet.fluxValue[2 * c], vertex);
            EXPECT_EQ(facet.fluxValue[2 * c + 1], -vertex);
            if (facet.robin >= 0)
            {
              EXPECT_EQ(facet.coefficient[c], 10.0 * vertex);
              EXPECT_EQ(facet.ambient[2 * c], vertex + 0.5);
            }
          }
        });
    }
    facets.release(final);
    vertices.release(final, final);
  };
  MemorySource source(mesh, blockCells);
  for (MeshBlock block; source.next(block);)
  {
    end += block.vertices();
    vertices.add(block);
    facets.extend(end);
    facets.add(block);
    take(block.finalized);
  }
  take(end);
  return found;
}

std::vector<Facet> boundaryOf(const StreamMesh& mesh, std::int64_t blockCells = 1000)
{
  Everywhere problem;
  Pool pool(std::int64_t(1) << 30);
  return boundaryOf(mesh, blockCells, problem, pool);
}

/** The facets of exactly one cell, by a map of all facets. */
std::set<Facet> expectedOf(const StreamMesh& mesh)
{
  const int size = cornersOf(mesh.cellType);
  std::map<Facet, int> cells;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    for (int k = 0; k < size; ++k)
    {
      Facet facet(&mesh.corners[size * c], &mesh.corners[size * c] + size);
      facet.erase(facet.begin() + k);
      std::ranges::sort(facet);
      ++cells[facet];
    }
  }
  std::set<Facet> boundary;
  for (const auto& [facet, count] : cells)
  {
    if (count == 1)
    {
      boundary.insert(facet);
    }
  }
  return boundary;
}

} // namespace

TEST(ProblemFacets, OfTheBoundaryAreThoseOfOneCell)
{
  for (const StreamMesh& mesh :
    { toStream(shuffled(grid(20, 15))), toStream(shuffled(torus(20, 15))),
      toStream(shuffled(tetBox(7, 6, 5))), toStream(shuffled(tetBox(5, 4, 3)), TestOrder::Keep) })
  {
    const std::set<Facet> expected = expectedOf(mesh);
    const std::vector<Facet> found = boundaryOf(mesh);
    EXPECT_EQ(std::set<Facet>(found.begin(), found.end()), expected);
    EXPECT_EQ(found.size(), expected.size());
    for (const std::int64_t cells : { 1, 13, 64, 65 })
    {
      EXPECT_EQ(boundaryOf(mesh, cells), found) << "blocks of " << cells << " cells";
    }
  }
}

TEST(ProblemFacets, WhereThreeCellsMeetIsNoBoundary)
{
  const IndexedTestMesh fan{ CellType::Triangle, { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1 },
    { 0, 1, 2, 0, 1, 3, 0, 1, 4 } };
  EXPECT_EQ(boundaryOf(toStream(fan)).size(), 6u);
}

TEST(ProblemFacets, FlatCellsCountButDuplicatesAndRepeatedCornersDoNot)
{
  // Two triangles, a flat one on the edge 1-2, a copy of the first and one without area.
  StreamMesh mesh;
  mesh.positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, 0.5, 0 };
  mesh.corners = { 0, 1, 2, 1, 3, 2, 2, 1, 0, 0, 1, 1 };
  const std::vector<std::uint8_t> flags{ 0, DegenerateCell, DuplicateCell, DegenerateCell };
  mesh.cellColumns.push_back(makeColumn<std::uint8_t>(CellFlagsName, flags));
  const std::vector<Facet> found = boundaryOf(mesh);
  EXPECT_EQ(std::set<Facet>(found.begin(), found.end()),
    (std::set<Facet>{ { 0, 1 }, { 0, 2 }, { 1, 3 }, { 2, 3 } }));
}

TEST(ProblemFacets, NeedMemoryForTheOpenOnesAlone)
{
  const auto peakOf = [](int length)
  {
    Everywhere problem;
    Pool pool(std::int64_t(1) << 30);
    const auto found = boundaryOf(toStream(tetBox(length, 5, 5)), 50, problem, pool);
    // Two triangles per square: two ends of 16 squares and four sides.
    EXPECT_EQ(found.size(), 2u * (2u * 16u + 4u * 4u * static_cast<std::size_t>(length - 1)));
    EXPECT_EQ(pool.used(), 0);
    return pool.peak();
  };
  const std::int64_t once = peakOf(40);
  EXPECT_GT(once, 0);
  EXPECT_LT(peakOf(160), once + once / 4);
}

TEST(ProblemFacets, OfAProblemThatSaysNothingOfThemAreThoseOfTheSameDirichletCondition)
{
  /** Two ends. */
  class Ends : public Problem
  {
  public:
    int columns() const override { return 1; }
    ConditionCounts conditionCounts() const override { return { 2, 0, 0 }; }
    void conditions(const MeshBlock& block, VertexConditions& conditions) override
    {
      for (std::int64_t i = 0; i < block.vertices(); ++i)
      {
        const double x = block.positions[3 * i];
        conditions.dirichlet[i] = x == 0 ? 0 : x == 9 ? 1 : -1;
      }
    }
  };
  Ends problem;
  Pool pool(std::int64_t(1) << 30);
  EXPECT_EQ(
    boundaryOf(toStream(tetBox(10, 4, 5)), 100, problem, pool).size(), std::size_t(2 * 2 * 12));
}

TEST(ProblemFacets, ValuesThatAreNotValidNameTheCellOnTheBoundaryAndDoNotMatterInside)
{
  const StreamMesh mesh = toStream(tetBox(5, 5, 5));
  const std::vector<Facet> boundary = boundaryOf(mesh);
  const std::set<Facet> ofBoundary(boundary.begin(), boundary.end());
  // A cell with a facet on the boundary, and one without.
  std::int64_t outer = -1, inner = -1;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    bool onBoundary = false;
    for (int k = 0; k < 4; ++k)
    {
      Facet facet(mesh.corners.begin() + 4 * c, mesh.corners.begin() + 4 * c + 4);
      facet.erase(facet.begin() + k);
      std::ranges::sort(facet);
      onBoundary = onBoundary || ofBoundary.contains(facet);
    }
    (onBoundary ? outer : inner) = c;
  }
  ASSERT_TRUE(outer >= 0 && inner >= 0);

  using Spoil = std::function<void(FacetBatch&, std::size_t)>;
  const auto errorOf = [&](std::int64_t cell, const Spoil& spoil)
  {
    Everywhere problem;
    problem.spoil = [&](FacetBatch& batch)
    {
      const auto first = batch.block.firstCell + static_cast<std::int64_t>(batch.first);
      for (std::size_t k = 0;
           first <= cell && cell < first + static_cast<std::int64_t>(batch.cells()) && k < 4; ++k)
      {
        spoil(batch, 4 * static_cast<std::size_t>(cell - first) + k);
      }
    };
    Pool pool(std::int64_t(1) << 30);
    return messageOf([&] { boundaryOf(mesh, 100, problem, pool); });
  };
  const auto isNamed = [&](const std::string& message)
  { return message.find("cell " + std::to_string(outer) + ' ') != std::string::npos; };
  const auto expectNamed = [&](const Spoil& spoil)
  {
    EXPECT_TRUE(isNamed(errorOf(outer, spoil)));
    EXPECT_EQ(errorOf(inner, spoil), "");
  };
  for (const double bad : { NotANumber, Infinite })
  {
    expectNamed([=](FacetBatch& b, std::size_t f) { b.fluxValue[6 * f] = bad; });
    expectNamed(
      [=](FacetBatch& b, std::size_t f)
      {
        b.robin[f] = 0;
        b.ambient[6 * f] = bad;
      });
  }
  for (const double bad : { NotANumber, Infinite, -1.0 })
  {
    expectNamed(
      [=](FacetBatch& b, std::size_t f)
      {
        b.robin[f] = 0;
        b.coefficient[3 * f] = bad;
      });
  }
  EXPECT_TRUE(isNamed(errorOf(outer, [](FacetBatch& b, std::size_t f) { b.flux[f] = 1; })));
  EXPECT_TRUE(isNamed(errorOf(outer, [](FacetBatch& b, std::size_t f) { b.robin[f] = 5; })));
  // Values without a condition are not used.
  EXPECT_EQ(errorOf(outer,
              [](FacetBatch& b, std::size_t f)
              {
                b.robin[f] = -1;
                b.coefficient[3 * f] = NotANumber;
              }),
    "");
}

} // namespace smg::testing
