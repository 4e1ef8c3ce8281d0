// SPDX-License-Identifier: BSD-3-Clause
// Solves a tiny problem on two processes with the installed library: a strip of triangles, values 0
// and 1 at its ends, half of the strip on each process.

#include <smg/DistributedSolver.h>

#include <cmath>
#include <iostream>

namespace
{

constexpr std::int64_t Columns = 41;
constexpr std::int64_t Middle = 20;

/** Vertex 2i and 2i+1 lie at (i, 0) and (i, 1). Process 0 has the vertices up to the middle, and
 * process 1 the others; both have cells at those of the middle. */
smg::MeshPart halfOfStrip(int rank)
{
  const std::int64_t first = rank == 0 ? 0 : Middle, last = rank == 0 ? Middle : Columns - 1;
  smg::MeshPart part;
  part.info.vertices = 2 * Columns;
  part.info.cells = 2 * (Columns - 1);
  part.info.bounds = { 0, Columns - 1.0, 0, 1, 0, 0 };
  part.firstOwned = rank == 0 ? 0 : 2 * (Middle + 1);
  part.endOwned = 2 * (last + 1);
  part.block.firstCell = 2 * first;
  for (std::int64_t i = first; i <= last; ++i)
  {
    const double x = static_cast<double>(i);
    part.ids.insert(part.ids.end(), { 2 * i, 2 * i + 1 });
    part.block.positions.insert(part.block.positions.end(), { x, 0, 0, x, 1, 0 });
    if (i > first)
    {
      const std::int64_t v = 2 * (i - first);
      part.block.corners.insert(part.block.corners.end(), { v - 2, v - 1, v, v - 1, v + 1, v });
    }
  }
  return part;
}

class Ends : public smg::Problem
{
public:
  int columns() const override { return 1; }
  void conditions(const smg::MeshBlock& block, smg::VertexConditions& conditions) override
  {
    for (std::int64_t v = 0; v < block.vertices(); ++v)
    {
      const double x = block.positions[3 * v];
      conditions.dirichlet[v] = x == 0 || x == Columns - 1 ? 0 : -1;
      conditions.value[v] = x == Columns - 1 ? 1.0 : 0.0;
    }
  }
};

/** Whether the solution of a part is linear along the strip, as the exact one is. */
bool isLinear(const smg::MeshPart& part, const smg::DistributedSolution& solution)
{
  bool linear = solution.values.size() == part.ids.size();
  for (std::size_t v = 0; linear && v < part.ids.size(); ++v)
  {
    linear = std::abs(solution.values[v] - part.block.positions[3 * v] / (Columns - 1)) < 1e-8;
  }
  return linear;
}

} // namespace

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  int rank = 0, processes = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &processes);
  bool right = processes == 2;
  if (right)
  {
    const smg::MeshPart part = halfOfStrip(rank);
    smg::DistributedSolver solver(MPI_COMM_WORLD, part);
    Ends ends;
    smg::DistributedOptions options;
    options.tolerance = 1e-12;
    smg::DistributedSolution solution = solver.solve(ends, options);
    solver.evaluate(ends, solution);
    const double energy = 0.5 / (Columns - 1);
    right = solution.report.converged && isLinear(part, solution) &&
            std::abs(solution.report.energy.at(0) - energy) < 1e-9;
  }
  MPI_Finalize();
  std::cout << "process " << rank << " of " << processes << (right ? ": right\n" : ": wrong\n");
  return right ? 0 : 1;
}
