// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Error.h"
#include "Solver/Solve.h"
#include "Testing/Support/ArrayProblem.h"
#include "Testing/Support/DirectSolve.h"
#include "Testing/Support/MemorySource.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{

/** The solution at all vertices, a row each, and what the solve did. */
struct Solved
{
  Eigen::MatrixXd values;
  Report report;
};

/** All values of a solution, read in one call. */
inline Eigen::MatrixXd valuesOf(Solution& solution)
{
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMajor values(solution.vertices(), solution.columns());
  solution.read(0, solution.vertices(), { values.data(), static_cast<std::size_t>(values.size()) });
  return values;
}

/** Solves on a mesh that comes in blocks of `blockCells` cells. */
inline Solved solveMesh(const StreamMesh& mesh, Problem& problem, const SolveOptions& options = {},
  std::int64_t blockCells = 1000)
{
  MemorySource source(mesh, blockCells);
  const std::unique_ptr<Solution> solution = solve(source, problem, options);
  return { valuesOf(*solution), solution->report() };
}

/** The same system, assembled in another way and solved directly. */
inline Eigen::MatrixXd solveDirectly(const StreamMesh& mesh, Problem& problem)
{
  MemorySource source(mesh);
  return solveDirect(assembleDirect(source, problem));
}

/** Options for a solve to nearly the last digit. */
inline SolveOptions accurate(double tolerance = 1e-10)
{
  SolveOptions options;
  options.tolerance = tolerance;
  return options;
}

/** Whether two matrices are the same to the last bit. */
inline bool sameBits(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

/** The sentence of the Error that `f` throws; empty if it throws none. */
template <class F>
std::string errorOf(F&& f)
{
  try
  {
    f();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return {};
}

/** Whether one of the report's notes contains `text`. */
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

/** The positions of all vertices, a row each. */
inline Eigen::MatrixXd positionsOf(const StreamMesh& mesh)
{
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(
    mesh.positions.data(), mesh.vertices(), 3);
}

/** Delivers blocks as they are, valid or not. */
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
  /** How many blocks have been asked for. */
  std::size_t delivered() const { return this->Next; }

private:
  StreamInfo Info;
  std::vector<MeshBlock> Blocks;
  std::size_t Next = 0;
};

} // namespace smg::testing
