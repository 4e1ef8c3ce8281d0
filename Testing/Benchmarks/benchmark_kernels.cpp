// SPDX-License-Identifier: BSD-3-Clause
// benchmark_kernels [MESH.vsm] : nanoseconds a node of each kernel of the solver, on one thread.
//
//   benchmark_kernels arm.vsm --benchmark_out=arm-kernels.json
//
// measures a whole level at a time, of the mesh or of a torus of 250,000 vertices, three columns:
//   sweep, restrict, prolong   a Gauss-Seidel sweep, residual and restriction, prolongation: in
//                              core, a level's blocks one after the other
//   assemble                   from the cells to the rows of the finest level
//   coarsen                    from a level's rows to those of the next one, a block at a time in
//                              windows, as the first pass of a solve does; its counters are the
//                              stages. `productPtAP` includes what makes coarse rows sparse and
//                              final, `pack` is the packing of rows into blocks.
// All counters are nanoseconds of processor time a node of the (finer) level, but `nodes` and
// `nonzeros` (a node).
// Takes the options of Google Benchmark (--help).

#include "Testing/Benchmarks/Kernels.h"
#include "smg/VsmReader.h"

#include <exception>
#include <iostream>
#include <string>

namespace
{

using namespace smg::testing;

StreamMesh meshOf(const std::string& path)
{
  const smg::VsmReader reader(path);
  return collect(*reader.source());
}

} // namespace

int main(int argc, char** argv)
try
{
  benchmark::Initialize(&argc, argv);
  const StreamMesh mesh = argc > 1 ? meshOf(argv[1]) : toStream(torus(708, 354, 0.25));
  smg::benchmark::addCycleKernels(mesh);
  smg::benchmark::addBuildKernels(mesh);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "benchmark_kernels: " << error.what() << '\n';
  return 1;
}
