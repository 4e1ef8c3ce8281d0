// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/CellAssembly.h"
#include "Solver/Assembly/RowAssembly.h"
#include "Solver/Memory/RaggedRing.h"
#include "Solver/Memory/Ring.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace smg::testing
{
namespace
{

/** Numbers that begin shortly below those which 31, 32 or 33 bits hold. */
const std::vector<std::int64_t> largeIndices = { (std::int64_t(1) << 31) - 100,
  (std::int64_t(1) << 32) - 100, (std::int64_t(1) << 33) - 100 };

} // namespace

TEST(LargeIndices, RingsKeepTheirItemsWhereverTheyBegin)
{
  for (const std::int64_t first : largeIndices)
  {
    Pool pool(1 << 24);
    Ring<std::int64_t> ring(pool, 3);
    ring.release(first);
    EXPECT_EQ(ring.first(), first);
    EXPECT_EQ(ring.end(), first);
    for (std::int64_t end = first; end < first + 20000;)
    {
      const std::int64_t begin = end;
      end += 1 + (end - first) % 700;
      ring.extend(end);
      EXPECT_EQ(*ring.at(begin), 0);
      for (std::int64_t i = begin; i < end; ++i)
      {
        std::iota(ring.at(i), ring.at(i) + 3, 3 * i);
      }
      ring.release(end - 900);
      for (std::int64_t i = ring.first(); i < end; ++i)
      {
        ASSERT_EQ(ring[i], 3 * i);
        ASSERT_EQ(ring.at(i)[2], 3 * i + 2);
      }
    }
    EXPECT_LT(pool.peak(), 200000);
  }
}

TEST(LargeIndices, RaggedRingsKeepTheirRowsWhereverTheyBegin)
{
  for (const std::int64_t first : largeIndices)
  {
    Pool pool(1 << 20);
    RaggedRing<std::int64_t> rows(pool);
    rows.release(first);
    EXPECT_EQ(rows.first(), first);
    for (std::int64_t row = first; row < first + 3000; ++row)
    {
      ASSERT_EQ(rows.end(), row);
      const std::int64_t size = row % 7;
      std::fill_n(rows.open(size + 3), size, row);
      rows.close(size);
      rows.release(row - 100);
      for (std::int64_t r = rows.first(); r <= row; ++r)
      {
        ASSERT_EQ(rows.size(r), r % 7);
        ASSERT_EQ(std::count(rows.row(r), rows.row(r) + r % 7, r), r % 7);
      }
    }
  }
}

/** What is released before it comes takes no room. */
TEST(LargeIndices, RaggedRingsGoOnBeyondTheirEnd)
{
  Pool pool(1 << 20);
  RaggedRing<int> rows(pool);
  std::fill_n(rows.open(5), 5, 1);
  rows.close(5);
  rows.release(std::int64_t(1) << 40);
  EXPECT_EQ(rows.end(), std::int64_t(1) << 40);
  std::fill_n(rows.open(2), 2, 7);
  rows.close(2);
  EXPECT_EQ(rows.size(std::int64_t(1) << 40), 2);
  EXPECT_EQ(*rows.row(std::int64_t(1) << 40), 7);
}

TEST(LargeIndices, MonotoneRingsBeginFarFromTheirInitialValue)
{
  for (const std::int64_t first : largeIndices)
  {
    Pool pool(1 << 20);
    MonotoneRing ring(pool, -1);
    ring.release(first);
    for (std::int64_t i = first; i < first + 1000; ++i)
    {
      ring.append(i % 3 == 0 ? 2 * i : 0);
      ring.release(i - 50);
      for (std::int64_t k = std::max(first + 2, i - 50); k <= i; ++k)
      {
        ASSERT_EQ(ring[k], 2 * (k / 3 * 3)) << k - first;
      }
    }
  }
}

namespace
{

/** A problem with values, sources, screening and conditions on the boundary that depend on the
 * position only. */
class AllKinds : public Problem
{
public:
  int columns() const override { return 2; }
  bool hasFacets() const override { return true; }
  ConditionCounts conditionCounts() const override { return { 1, 1, 1 }; }
  void conditions(const MeshBlock& block, VertexConditions& conditions) override
  {
    for (std::int64_t v = 0; v < block.vertices(); ++v)
    {
      const double x = block.positions[3 * v];
      const double y = block.positions[3 * v + 1];
      conditions.dirichlet[v] = x + y < 2.0 ? 0 : -1;
      conditions.value[2 * v] = x;
      conditions.value[2 * v + 1] = y;
      conditions.source[2 * v] = x * y;
      conditions.screening[v] = y > 5.0 ? 0.25 : 0.0;
    }
  }
  void facets(FacetBatch& batch) override
  {
    for (std::size_t facet = 0; facet < batch.flux.size(); ++facet)
    {
      const bool isFlux = facet % 2 == 0;
      batch.flux[facet] = isFlux ? 0 : -1;
      batch.robin[facet] = isFlux ? -1 : 0;
    }
    std::ranges::fill(batch.fluxValue, 1.5);
    std::ranges::fill(batch.coefficient, 0.5);
    std::ranges::fill(batch.ambient, -2.0);
  }
};

/** The rows of the finest level relative to the first vertex, and their data. */
struct Rows
{
  std::vector<std::vector<RowEntry>> entries;
  std::vector<double> rowSum, x, b;
  std::vector<std::int64_t> reach;
  std::int64_t components = 0;
};

/** Assembles a mesh whose first vertex and cell have this number. */
class LargeAssembly
{
public:
  LargeAssembly(std::int64_t first, CellType type)
    : First(first)
    , Parts(this->Asked.columns(), &this->Memory)
    , Labels(this->Parts)
    , Cells(this->Memory, type, this->Asked, this->Out.weightScale, this->Parts, this->Labels)
    , Assembled(
        type, this->Cells.vertices, this->Asked, this->Out, this->Parts, SliverRows(), nullptr)
    , Level(this->Memory)
    , Final(first)
  {
    this->Cells.vertices.release(first, first);
    this->Cells.parts.release(first);
    this->Cells.edges.release(first);
    this->Cells.loads.release(first);
    this->Level.release(first, first);
  }

  Rows operator()(MemorySource& source)
  {
    for (MeshBlock block; source.next(block);)
    {
      block.firstVertex += this->First;
      block.firstCell += this->First;
      block.finalized += this->First;
      for (std::int64_t& corner : block.corners)
      {
        corner += this->First;
      }
      this->Cells.add(block);
      this->close(block.finalized);
    }
    this->close(this->Cells.vertices.end());
    this->Made.x = this->Out.x;
    this->Made.b = this->Out.b;
    this->Made.components = this->Parts.components();
    return this->Made;
  }

private:
  void close(std::int64_t end)
  {
    FinalVertices made;
    made.clear(this->Final);
    for (; this->Final < end; ++this->Final)
    {
      const std::int64_t i = this->Final;
      this->Cells.edges.take(i, this->Cells.vertices.points, made.neighbours);
      const double rowSum = this->Cells.loads.close(i);
      const double mass = this->Cells.vertices.mass[i];
      const double* load = this->Cells.loads.load();
      made.loads.insert(made.loads.end(), load, load + this->Asked.columns());
      made.vertices.push_back(
        { made.neighbours.size(), rowSum, mass, i, 1.0F, this->Cells.parts.close(i, mass) });
      this->Assembled.close(made, made.vertices.size() - 1);
    }
    this->Cells.parts.flush();
    this->Cells.parts.release(end);
    this->Cells.edges.release(end);
    this->Cells.loads.release(end);
    const std::int64_t begin = this->Level.end();
    this->Out.rows.moveTo(this->Level);
    for (std::int64_t i = begin; i < this->Level.end(); ++i)
    {
      const auto row = this->Level.row(i);
      this->Made.entries.emplace_back(row.begin(), row.end());
      this->Made.rowSum.push_back(this->Level.rowSum(i));
      this->Made.reach.push_back(this->Level.reach(i) - this->First);
    }
    this->Level.release(end, end);
  }

  std::int64_t First;
  Pool Memory{ std::int64_t(1) << 28 };
  AllKinds Asked;
  AssembledRows Out{ this->Memory, this->Asked.columns(), false };
  Components Parts;
  ComponentLabels Labels;
  CellAssembly Cells;
  RowAssembly Assembled;
  LevelRows Level;
  std::int64_t Final;
  Rows Made;
};

bool isSame(const std::vector<RowEntry>& a, const std::vector<RowEntry>& b)
{
  return std::ranges::equal(a, b,
    [](const RowEntry& x, const RowEntry& y)
    { return x.delta() == y.delta() && x.weight() == y.weight(); });
}

} // namespace

TEST(LargeIndices, TheRowsOfAMeshAreTheSameBits)
{
  for (const StreamMesh& mesh :
    { toStream(shuffled(grid(40, 25, 0.1))), toStream(shuffled(tetBox(9, 8, 10, 0.1))) })
  {
    MemorySource source(mesh, 150);
    const Rows expected = LargeAssembly(0, mesh.cellType)(source);
    ASSERT_EQ(std::ssize(expected.entries), mesh.vertices());
    for (const std::int64_t first : largeIndices)
    {
      source.rewind(150);
      const Rows rows = LargeAssembly(first, mesh.cellType)(source);
      EXPECT_TRUE(std::ranges::equal(rows.entries, expected.entries, isSame)) << first;
      EXPECT_EQ(rows.rowSum, expected.rowSum) << first;
      EXPECT_EQ(rows.x, expected.x) << first;
      EXPECT_EQ(rows.b, expected.b) << first;
      EXPECT_EQ(rows.reach, expected.reach) << first;
      EXPECT_EQ(rows.components, expected.components) << first;
    }
  }
}

} // namespace smg::testing
