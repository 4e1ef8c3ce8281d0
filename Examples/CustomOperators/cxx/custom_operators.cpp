// SPDX-License-Identifier: BSD-3-Clause
/*
User-defined operators and weights, in C++ without VTK.

What this lesson shows:
 1. An operator set is a type. A set that differs in a single operator derives from Extended, the
    default set, and hides that member: here the relaxation is SOR instead of Gauss-Seidel.
    solveWith() compiles the streaming multigrid for it.
 2. A set in terms of rows derives from RowOperators and says which nodes are C-points and what an
    F-point takes from them: here direct interpolation from strong neighbours.
 3. The problem provides the weights cell by cell, in batches: here every cell consists of wires,
    with a conductance of one over their length, instead of a sheet (cotangent weights).
 4. Everything else, such as memory limit, scratch files and report, is as for solve().

Data that a sweep may read: the node, its row, and the neighbours that the row names. No other node
is guaranteed to be in memory. There is one x per node: when a node is relaxed, its earlier
neighbours in the stream have been relaxed in this sweep, the later ones have not. This is the order
of Gauss-Seidel and SOR. Jacobi, which also needs the old values of earlier neighbours, and backward
sweeps are not possible.

Run it:

    custom_operators ../../Data/bunny.smb

    sheet, extended: converged after 8 cycles, relative residual 2.96724e-11
    sheet, over-relaxed: converged after 8 cycles, relative residual 1.07642e-11
    sheet, direct: converged after 14 cycles, relative residual 7.83529e-11
    wires, extended: converged after 9 cycles, relative residual 1.716e-13
    wires, over-relaxed: converged after 8 cycles, relative residual 1.67796e-12
    wires, direct: converged after 14 cycles, relative residual 1.87277e-12
*/

#include <smg/Convert.h>
#include <smg/SolveWith.h>

#include <algorithm>
#include <cmath>
#include <iostream>

/** Successive over-relaxation: Factor times the step of Gauss-Seidel. */
struct OverRelaxation
{
  static constexpr double Factor = 1.15;

  template <bool LowerOnly, class Vectors, class Real>
  static void sweep(const auto& header, const auto& rows, smg::BlockRange nodes,
    std::int64_t stride, Real* x, const Real* b)
  {
    for (std::int64_t k = nodes.begin; k < nodes.end; ++k)
    {
      const auto sum = smg::neighbourSum<LowerOnly, Vectors>(header, rows, k, stride, x);
      const auto solved =
        (Vectors::load(b + k * stride) + sum) * static_cast<Real>(1.0 / rows.diagonal[k]);
      // LowerOnly: the first sweep on a coarse level, where the initial guess is zero.
      typename Vectors::Vector old{};
      if (!LowerOnly)
      {
        old = Vectors::load(x + k * stride);
      }
      Vectors::store(x + k * stride, old + static_cast<Real>(Factor) * (solved - old));
    }
  }
};

/** The default operator set except for its relaxation. */
struct OverRelaxed : smg::Extended
{
  static constexpr const char* name = "over-relaxed";
  using Relaxation = OverRelaxation;
  static OverRelaxed forCells(smg::CellType type) { return { Extended::forCells(type) }; }
};

/** Direct interpolation (Ruge and Stueben, 1987): an F-point takes from its strong C-neighbours
 * what the weights say. */
struct Direct : smg::RowOperators<Direct>
{
  static constexpr const char* name = "direct";

  static bool isStrong(const smg::FineRow& row, const smg::FineRow::Neighbour& other)
  {
    return other.isCoarse && other.weight >= 0.25F * row.strongest();
  }
  bool isCPoint(const smg::FineRow& row) const
  {
    return !row.empty() && std::ranges::none_of(row.neighbours(),
                             [&](const auto& other) { return isStrong(row, other); });
  }
  void weightsOf(const smg::FineRow& row, smg::InterpolationWeights& P) const
  {
    double sum = row.rowSum();
    for (const auto& other : row.neighbours())
    {
      sum += isStrong(row, other) ? other.weight : 0.0F;
    }
    for (const auto& other : row.neighbours())
    {
      if (isStrong(row, other))
      {
        P.append(other.coarse, other.weight / sum);
      }
    }
  }
};

/** 0 at the feet of the bunny, 1 at the tips of its ears; sheets or wires conduct in between. */
struct FeetAndEars : smg::Problem
{
  bool wires = false;

  int columns() const override { return 1; }
  smg::Weights weights() const override { return smg::Weights::Clamped; }
  bool hasCells() const override { return this->wires; }
  void cells(smg::CellBatch& batch) override
  {
    for (std::size_t c = 0; c < batch.cells(); ++c)
    {
      for (int e = 0; e < smg::edgesOf(batch.type); ++e)
      {
        const int* ends = smg::edgeCorners(batch.type, e);
        const double* p = batch.point(c, ends[0]);
        const double* q = batch.point(c, ends[1]);
        batch.weightsOf(c)[e] = 1 / std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
      }
    }
  }
  void conditions(const smg::MeshBlock& block, smg::VertexConditions& conditions) override
  {
    for (std::int64_t i = 0; i < block.vertices(); ++i)
    {
      const double height = block.positions[3 * i + 1]; // metres
      conditions.dirichlet[i] = height < 0.036 || height > 0.18 ? 0 : -1;
      conditions.value[i] = height > 0.18 ? 1.0 : 0.0;
    }
  }
};

template <smg::OperatorSet Operators>
void solveAndPrint(const smg::StoredMesh& mesh, FeetAndEars& problem)
{
  smg::SolveOptions options;
  options.tolerance = 1e-10;
  const auto solution = smg::solveWith<Operators>(*mesh.source({}, {}), problem, options);
  const smg::Report& report = solution->report();
  std::cout << (problem.wires ? "wires" : "sheet") << ", " << Operators::name << ": "
            << (report.converged ? "converged" : "not converged") << " after " << report.cycles
            << " cycles, relative residual " << report.residual() << "\n";
}

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::cerr << "usage: custom_operators MESH\n";
    return 2;
  }
  try
  {
    const auto mesh = smg::openMesh(argv[1]);
    FeetAndEars problem;
    for (const bool wires : { false, true })
    {
      problem.wires = wires;
      solveAndPrint<smg::Extended>(*mesh, problem);
      solveAndPrint<OverRelaxed>(*mesh, problem);
      solveAndPrint<Direct>(*mesh, problem);
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
