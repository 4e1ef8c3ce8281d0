// SPDX-License-Identifier: BSD-3-Clause
// Whatever a job keeps of a stream counts within its memory limit, whose error names the bytes.
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Setup/RowBatch.h"
#include "Testing/Support/ErrorMessage.h"
#include "smg/Blend.h"
#include "smg/DescribedHandles.h"
#include "smg/DescribedProblem.h"
#include "smg/Distance.h"
#include "smg/Smooth.h"
#include "smg/Solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

constexpr std::int64_t Limit = std::int64_t(4) << 20;

/** Triangles that share no vertex, of which none is final before the end: made as they are read, so
 * that only the reader keeps anything. */
class EndlessStream : public MeshSource
{
public:
  EndlessStream(const StreamInfo& info, std::int64_t& verticesRead)
    : Info(info)
    , Read(verticesRead)
  {
    this->Read = 0;
  }

  const StreamInfo& info() const override { return this->Info; }

  bool next(MeshBlock& block) override
  {
    constexpr std::int64_t Cells = 1024;
    block.firstCell = this->Read / 3;
    block.firstVertex = this->Read;
    block.finalized = 0;
    block.corners.resize(3 * Cells);
    block.positions.resize(9 * Cells);
    for (std::int64_t k = 0; k < 3 * Cells; ++k)
    {
      const std::int64_t v = this->Read + k;
      const auto at = static_cast<std::size_t>(k);
      block.corners[at] = v;
      block.positions[3 * at] = static_cast<double>(v / 3) + (v % 3 == 1 ? 0.5 : 0.0);
      block.positions[3 * at + 1] = v % 3 == 2 ? 0.5 : 0.0;
      block.positions[3 * at + 2] = 0.0;
    }
    const auto column = [](const ColumnSpec& spec, std::int64_t rows) {
      return Column{ spec, std::vector<std::byte>(static_cast<std::size_t>(rows) * 8) };
    };
    block.vertexColumns = { column(this->Info.vertexColumns[0], 3 * Cells) };
    block.cellColumns = { column(this->Info.cellColumns[0], Cells) };
    this->Read += 3 * Cells;
    return true;
  }

private:
  const StreamInfo& Info;
  std::int64_t& Read;
};

/** The mesh of that stream, which tells how much of the last one was read. */
class EndlessMesh : public StoredMesh
{
public:
  EndlessMesh()
  {
    this->Info.cellType = CellType::Triangle;
    this->Info.span = 2;
    this->Info.vertexColumns = { { "v", ScalarType::Float64, 1 } };
    this->Info.cellColumns = { { "c", ScalarType::Float64, 1 } };
  }

  const StreamInfo& info() const override { return this->Info; }
  std::unique_ptr<MeshSource> source(
    std::vector<std::string> /*vertices*/, std::vector<std::string> /*cells*/) const override
  {
    return this->source();
  }
  std::unique_ptr<MeshSource> source() const
  {
    return std::make_unique<EndlessStream>(this->Info, this->Read);
  }
  std::int64_t verticesRead() const { return this->Read; }

private:
  StreamInfo Info;
  mutable std::int64_t Read = 0;
};

/** Expects that reading the endless stream ends with the error of the limit while `least` bytes of
 * each vertex read have room in it, but for a block and what a growing memory has in advance. */
template <class Read>
void expectLimit(const std::string& operation, std::int64_t least, Read&& read)
{
  const EndlessMesh mesh;
  const std::string message = messageOf([&] { read(mesh); });
  EXPECT_TRUE(message.starts_with(operation + " needs at least ")) << message;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring,
    "of memory but the limit is 4 MiB (" + std::to_string(Limit) + " bytes): raise the memory",
    message);
  EXPECT_GT(mesh.verticesRead(), 3 * 1024) << "a limit that allows nothing";
  EXPECT_LE(least * mesh.verticesRead(), Limit + Limit / 4);
}

const std::string Selecting = "finding the selected parts of the mesh";

/** A problem that keeps so many bytes of each vertex. */
class KeepingProblem : public Problem
{
public:
  explicit KeepingProblem(std::int64_t each)
    : Each(each)
  {
  }
  int columns() const override { return 1; }
  Weights weights() const override { return Weights::Uniform; }
  void conditions(const MeshBlock& block, VertexConditions& /*conditions*/) override
  {
    this->Kept += this->Each * block.vertices();
  }
  std::int64_t bytes() const override { return this->Kept; }

private:
  std::int64_t Each, Kept = 0;
};

} // namespace

TEST(MemoryPromise, HoldsWhileABoundaryIsFound)
{
  ProblemDescription description;
  description.dirichlet = { { OnBoundary{}, 1.0 } };
  // An edge of each vertex, and its mark.
  expectLimit(Selecting, 17,
    [&](const EndlessMesh& mesh)
    { DescribedProblem(description, mesh.info()).prepare(*mesh.source(), {}, Limit); });
}

TEST(MemoryPromise, HoldsWhileTheVerticesOfCellsAreFound)
{
  ProblemDescription description;
  description.dirichlet = { { ColumnTag{ "c", 0.0 }, 1.0 } };
  expectLimit(Selecting, 1,
    [&](const EndlessMesh& mesh)
    { DescribedProblem(description, mesh.info()).prepare(*mesh.source(), {}, Limit); });
}

TEST(MemoryPromise, HoldsWhileHandlesAreFound)
{
  DeformationDescription description;
  description.handles.resize(1);
  description.handles[0].where = OnBoundary{};
  expectLimit(Selecting, 17,
    [&](const EndlessMesh& mesh)
    { DescribedHandles(description, mesh.info()).prepare(*mesh.source(), {}, Limit); });
}

TEST(MemoryPromise, HoldsWhileTheSourcesOfADistanceAreFound)
{
  DistanceDescription description;
  description.from = { OnBoundary{} };
  DistanceOptions options;
  options.memoryLimit = Limit;
  expectLimit(
    "a distance", 17, [&](const EndlessMesh& mesh) { distance(mesh, description, options); });
}

TEST(MemoryPromise, HoldsWhileTheSeamsOfPatchesAreFound)
{
  BlendDescription description;
  description.patch = "c";
  description.columns = { "v" };
  SolveOptions options;
  options.memoryLimit = Limit;
  // The label of the first cell, and whether there are others.
  expectLimit(Selecting, 9, [&](const EndlessMesh& mesh) { blend(mesh, description, options); });
}

TEST(MemoryPromise, HoldsWhileAMeshToSmoothIsSurveyed)
{
  Smoothing options;
  options.memoryLimit = Limit;
  options.boundary = SmoothedBoundary::Fixed;
  // What finds the boundary, and the positions.
  expectLimit(
    "the solve", 17 + 24, [&](const EndlessMesh& mesh) { smooth(mesh, options, options); });
}

TEST(MemoryPromise, CountsWhatAProblemKeeps)
{
  constexpr std::int64_t Each = 100;
  SolveOptions options;
  options.memoryLimit = Limit;
  options.threads = 1;
  KeepingProblem problem(Each);
  expectLimit(
    "the solve", Each, [&](const EndlessMesh& mesh) { solve(*mesh.source(), problem, options); });
}

/** As of a stream whose last block makes all of its vertices final at once. */
TEST(MemoryPromise, HoldsForTheRowsOfAStep)
{
  constexpr std::int64_t Entries = 7, Further = 16;
  constexpr std::int64_t Least = Entries * std::int64_t(sizeof(RowEntry)) + Further;
  Pool pool(Limit);
  RowBatch batch(pool, Further);
  const auto close = [&batch]
  {
    std::fill_n(batch.open(Entries), Entries, RowEntry());
    batch.close(Entries, 1.0, 0);
  };
  for (int k = 0; k < 100; ++k)
  {
    close();
  }
  EXPECT_EQ(pool.used(), 0) << "usual blocks change no memory that is reported";
  std::int64_t rows = 100;
  EXPECT_THROW(
    {
      for (;; ++rows)
      {
        close();
      }
    },
    Error);
  EXPECT_LE(rows * Least, UnaccountedBytes + Limit + (1 << 16));
}

TEST(MemoryPromise, CountsTheValuesOfADescribedProblem)
{
  // One value of each open vertex, for the facets: with all vertices open, of the same stream.
  ProblemDescription description;
  description.flux = { { Everywhere{}, DataValue(std::string("v")) } };
  const EndlessMesh mesh;
  const auto stream = mesh.source();
  DescribedProblem problem(description, mesh.info());
  VertexConditions conditions;
  MeshBlock block;
  for (int k = 0; k < 50; ++k)
  {
    stream->next(block);
    const auto count = static_cast<std::size_t>(block.vertices());
    conditions.dirichlet.assign(count, -1);
    conditions.value.assign(count, 0.0);
    conditions.source.assign(count, 0.0);
    conditions.screening.assign(count, 0.0);
    problem.conditions(block, conditions);
    EXPECT_GE(problem.bytes(), 8 * mesh.verticesRead());
    EXPECT_LE(problem.bytes(), 8 * mesh.verticesRead() * 9 / 8 + 64);
  }
}

} // namespace smg::testing
