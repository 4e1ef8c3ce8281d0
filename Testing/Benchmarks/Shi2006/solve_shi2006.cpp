// SPDX-License-Identifier: BSD-3-Clause
// solve_shi2006 MESH PROBLEM.json OUT [SWEEPS] : solves a problem (docs/problem.md) with the
// equations as the paper "Out-of-Core Multigrid Solver for Streaming Meshes" prints them, in core.
//
//   solve_shi2006 bunny.vsm problem.json biased.vsm
//
// Prints the report. OUT has the mesh with the values to which the equations lead, which are not
// the solution (Shi2006.h); `smg solve` computes that.

#include "Testing/Benchmarks/Shi2006/Shi2006.h"
#include "smg/Convert.h"
#include "smg/DescribedProblem.h"
#include "smg/DescriptionFiles.h"
#include "smg/SolvedMesh.h"

#include <cstdlib>
#include <exception>
#include <iostream>

int main(int argc, char** argv)
try
{
  if (argc < 4 || argc > 5)
  {
    std::cerr << "usage: solve_shi2006 MESH PROBLEM.json OUT [SWEEPS]\n";
    return 2;
  }
  const auto mesh = smg::openMesh(argv[1]);
  const smg::ProblemDescription description = smg::readProblemFile(argv[2]);
  smg::SolveOptions options;
  options.sweeps = argc > 4 ? std::atoi(argv[4]) : options.sweeps;
  smg::DescribedProblem problem(description, mesh->info(), argv[2]);
  const auto source = [&] { return mesh->source(problem.vertexColumns(), problem.cellColumns()); };
  problem.prepare(*source(), options.scratch, options.memoryLimit);
  smg::Shi2006 solution(problem.columns(), options);
  solution.solve(*source(), problem);
  std::cout << smg::write(*mesh, description, solution, argv[3]).json() << "\n";
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "solve_shi2006: " << error.what() << "\n";
  return 1;
}
