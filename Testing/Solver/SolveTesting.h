// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/ArrayProblem.h"
#include "Testing/Support/DirectSolve.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/SolveMesh.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{

/** Assembles the same system independently and solves it directly. */
inline Eigen::MatrixXd solveDirectly(const StreamMesh& mesh, Problem& problem)
{
  MemorySource source(mesh);
  return solveDirect(assembleDirect(source, problem));
}

/** Options for a solve to high accuracy. */
inline SolveOptions accurate(double tolerance = 1e-10)
{
  SolveOptions options;
  options.tolerance = tolerance;
  return options;
}

/** Whether a note of the report contains `text`. */
inline bool hasNote(const Report& report, const std::string& text)
{
  for (const std::string& note : report.notes)
  {
    if (note.find(text) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

/**
 * A problem of `columns` columns on any mesh: vertices with the lowest and the highest x (5 % of
 * the width each) are prescribed, to values between -1 and 1.
 */
inline ArrayProblem heldEnds(const StreamMesh& mesh, int columns, Weights weights)
{
  double low = mesh.positions[0];
  double high = low;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    low = std::min(low, mesh.positions[3 * v]);
    high = std::max(high, mesh.positions[3 * v]);
  }
  ArrayProblem problem;
  problem.Columns = columns;
  problem.EdgeWeights = weights;
  problem.Prescribed.resize(mesh.vertices());
  problem.Value.resize(columns * mesh.vertices());
  Random random(17);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double x = mesh.positions[3 * v];
    const double margin = 0.05 * (high - low);
    problem.Prescribed[v] = x < low + margin || x > high - margin;
    for (int k = 0; problem.Prescribed[v] && k < columns; ++k)
    {
      problem.Value[columns * v + k] = random.uniform(-1.0, 1.0);
    }
  }
  return problem;
}

/** The positions of all vertices, one row per vertex. */
inline Eigen::MatrixXd positionsOf(const StreamMesh& mesh)
{
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(
    mesh.positions.data(), mesh.vertices(), 3);
}

/** Delivers the given blocks, valid or not. */
class BlockSource : public MeshSource
{
public:
  BlockSource(CellType type, std::vector<MeshBlock> blocks)
    : Blocks(std::move(blocks))
  {
    this->Info.cellType = type;
    for (const MeshBlock& block : this->Blocks)
    {
      this->Info.vertices += block.vertices();
      this->Info.cells += static_cast<std::int64_t>(block.corners.size()) / cornersOf(type);
    }
  }

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override
  {
    if (this->Next == this->Blocks.size())
    {
      return false;
    }
    block = this->Blocks[this->Next++];
    return true;
  }
  /** The number of requested blocks. */
  std::size_t delivered() const { return this->Next; }

private:
  StreamInfo Info;
  std::vector<MeshBlock> Blocks;
  std::size_t Next = 0;
};

/** Two triangles in two blocks. */
inline std::vector<MeshBlock> twoBlocks()
{
  MeshBlock first;
  first.positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
  first.corners = { 0, 1, 2 };
  MeshBlock second;
  second.firstVertex = 3;
  second.firstCell = 1;
  second.positions = { 1, 1, 0 };
  second.corners = { 1, 3, 2 };
  second.finalized = 4;
  return { first, second };
}

} // namespace smg::testing
