// SPDX-License-Identifier: BSD-3-Clause
/*
The operators of the paper, streamed, in C++ without VTK.

What this lesson shows:
 1. The paper's choice of coarse nodes and its interpolation are two functions of a row:
    PaperOperators.h beside this file. They know nothing of files, windows or threads.
 2. The same operators run out of core and in core, and give the same bits. A row of the table below
    is a solve out of core; a second one in core checks its bits. "alone": the V-cycles that a
    third one takes without acceleration.
 3. Hiding one member more, sparsify(), replaces the coarse operator: "paper, full" is the Galerkin
    product itself.

The field is harmonic: 0 at the feet of the bunny, 1 at the tips of its ears. "lifted": how many
percent of the nodes of each level are nodes of the next one. The paper expects "approximately one
third". The default set (extended) interpolates from two rings instead of one, so that a V-cycle
takes more memory and there are fewer of them. The memory is that of the solve out of core on two
threads.

Run it:

    paper_operators ../../Data/bunny.smb

    | weights | operators | V-cycles | alone | passes | residual | levels | lifted | memory |
    |---|---|---|---|---|---|---|---|---|
    | cotangent | extended | 6 | 9 | 7 | 6.9e-09 | 4 | 42 25 24 | 12.3 MiB |
    | cotangent | paper | 13 | 29 | 14 | 8.4e-09 | 4 | 28 29 24 | 9.5 MiB |
    | cotangent | paper, full | 17 | 44 | 18 | 4.2e-09 | 4 | 28 23 19 | 9.6 MiB |
    | clamped | extended | 6 | 9 | 7 | 6.3e-09 | 4 | 43 25 24 | 11.7 MiB |
    | clamped | paper | 14 | 29 | 15 | 3.8e-09 | 4 | 28 29 23 | 9.4 MiB |
    | clamped | paper, full | 17 | 48 | 18 | 7.8e-09 | 4 | 28 24 19 | 9.5 MiB |
    Streamed and in core: the same bits.
*/

#include "PaperOperators.h"

#include <smg/Convert.h>

#include <cmath>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

/** 0 at the lowest twentieth of the height of a mesh, 1 at the highest one. */
struct LowToHigh : smg::Problem
{
  smg::Weights kind;
  double low, high;

  LowToHigh(smg::Weights weights, const smg::StreamInfo& mesh)
    : kind(weights)
    , low(std::lerp(mesh.bounds[2], mesh.bounds[3], 0.05))
    , high(std::lerp(mesh.bounds[2], mesh.bounds[3], 0.95))
  {
  }
  int columns() const override { return 1; }
  smg::Weights weights() const override { return this->kind; }
  void conditions(const smg::MeshBlock& block, smg::VertexConditions& conditions) override
  {
    for (std::int64_t i = 0; i < block.vertices(); ++i)
    {
      const double height = block.positions[3 * i + 1];
      conditions.dirichlet[i] = height < this->low || height > this->high ? 0 : -1;
      conditions.value[i] = height > this->high ? 1.0 : 0.0;
    }
  }
};

std::vector<double> valuesOf(smg::Solution& solution)
{
  std::vector<double> values(solution.vertices());
  solution.read(0, solution.vertices(), values);
  return values;
}

/** The share of the nodes of each level that the next one has, in percent. */
std::string liftedShares(const smg::Report& report)
{
  std::string text;
  for (std::size_t l = 1; l < report.levels.size(); ++l)
  {
    const auto all = static_cast<double>(report.levels[l - 1].nodes);
    const auto lifted = static_cast<double>(report.levels[l].nodes);
    text += (l > 1 ? " " : "") + std::to_string(std::lround(100 * lifted / all));
  }
  return text;
}

std::string cyclesOf(const smg::Report& report)
{
  return (report.converged ? "" : "more than ") + std::to_string(report.cycles);
}

/** Solves out of core, in core, and without acceleration, and prints a row of the table. Returns
 * whether the first two gave the same bits. */
template <smg::OperatorSet Operators>
bool compare(const smg::StoredMesh& mesh, LowToHigh problem)
{
  smg::SolveOptions options;
  options.maxCycles = 200;
  options.blockNodes = 512;
  // By default a mesh of this size would stay in memory. Now its largest levels are streamed.
  options.coreNodes = mesh.info().vertices / 32;
  const auto solved = [&]
  { return smg::solveWith<Operators>(*mesh.source({}, {}), problem, options); };
  const auto streamed = solved();
  options.inCore = true;
  const bool same = valuesOf(*streamed) == valuesOf(*solved());
  options.acceleration = smg::AccelerationKind::None;
  const std::string alone = cyclesOf(solved()->report());

  const smg::Report& report = streamed->report();
  std::ostringstream row;
  row << "| " << (problem.kind == smg::Weights::Clamped ? "clamped" : "cotangent") << " | "
      << Operators::name << " | " << cyclesOf(report) << " | " << alone << " | " << report.passes
      << " | " << std::scientific << std::setprecision(1) << report.residual() << " | "
      << report.levels.size() << " | " << liftedShares(report) << " | " << std::fixed
      << static_cast<double>(report.pool_bytes_peak) / smg::MiB << " MiB |\n";
  std::cout << row.str() << std::flush;
  return same;
}

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::cerr << "usage: paper_operators MESH\n";
    return 2;
  }
  try
  {
    const auto mesh = smg::openMesh(argv[1]);
    std::cout << "| weights | operators | V-cycles | alone | passes | residual | "
                 "levels | lifted | memory |\n|---|---|---|---|---|---|---|---|---|\n";
    bool same = true;
    for (const smg::Weights weights : { smg::Weights::Cotangent, smg::Weights::Clamped })
    {
      const LowToHigh problem(weights, mesh->info());
      same = compare<smg::Extended>(*mesh, problem) && same;
      same = compare<PaperOperators>(*mesh, problem) && same;
      same = compare<FullPaperOperators>(*mesh, problem) && same;
    }
    std::cout << (same ? "Streamed and in core: the same bits.\n"
                       : "Streamed and in core: NOT the same bits.\n");
    return same ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
