// SPDX-License-Identifier: BSD-3-Clause
/*
Heat conduction in a chip and its heat sink, out of core, in C++ without VTK.

Two materials conduct: the ceramic of the chip 25 W/(m K), the aluminium of the heat sink
200 W/(m K). Heat flows in through the bottom of the chip, 100 kW/m^2, and is taken by air of 20
degrees at the top of the plate and at the fins, 100 W/(m^2 K). Everything else is insulated.

What this lesson shows:
 1. A problem is said in the words of physics: conductivity, flux and heat transfer, each with where
    it holds: cells by a column of the mesh, facets of the boundary by regions. A facet is in a
    region if all its corners are. heat.json beside this lesson says the same to the program smg.
 2. DescribedProblem brings that to a mesh stream; prepare() finds what is selected, and says what
    selects nothing, before the work.
 3. SolvedMesh is the mesh stream with the solution, and with the gradient and the flux in the
    cells; a writer takes it block by block. When it has been read to its end, the report says what
    flows through each condition, where the body is hottest, and how well all flows balance.

Run it:

    heat_conduction ../../Data/heat_sink.vtk heat.vtu

    2116 vertices, 6822 cells: converged after 7 cycles, relative residual 8.84191e-08
    peak: 67.8414 degrees at vertex 36 of the file
    flux[0]: 19.6 W into the body through 196 mm^2 of 67.2205 degrees
    robin[0]: -19.6 W into the body through 5476 mm^2 of 55.7925 degrees
    what is missing in the balance of all: -1.04355e-09
*/

#include <smg/DescribedProblem.h>
#include <smg/OpenMesh.h>
#include <smg/Solve.h>
#include <smg/SolvedMesh.h>
#include <smg/WriteMesh.h>

#include <iostream>

namespace
{

/** Lengths are in metres; z points up, from the chip to the fins. */
smg::ProblemDescription chipAndHeatSink()
{
  const smg::Region::HalfSpace bottom{ { 0, 0, -1 }, -0.001 }; // z <= 1 mm
  const smg::Region::HalfSpace air{ { 0, 0, 1 }, 0.005 };      // z >= 5 mm

  smg::ProblemDescription heat;
  heat.conductivity = { { smg::Everywhere{}, 25.0 }, { smg::ColumnTag{ "Material", 2 }, 200.0 } };
  heat.flux = { { bottom, 100000.0 } };
  heat.robin = { { air, 100.0, 20.0 } };
  heat.gradientOutput = true;
  heat.fluxOutput = true;
  return heat;
}

void print(const smg::Report& report)
{
  std::cout << report.vertices << " vertices, " << report.cells
            << " cells: " << (report.converged ? "converged" : "not converged") << " after "
            << report.cycles << " cycles, relative residual " << report.residual() << "\n";
  const smg::Report::Extreme& peak = report.maximum[0];
  std::cout << "peak: " << peak.value << " degrees at vertex " << peak.vertex << " of the file\n";
  for (const smg::Report::Condition& condition : report.conditions)
  {
    std::cout << condition.name << ": " << condition.flux[0] << " W into the body through "
              << 1e6 * condition.area << " mm^2 of " << condition.mean[0] << " degrees\n";
  }
  std::cout << "what is missing in the balance of all: " << report.balance[0] << "\n";
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: heat_conduction MESH HEAT.vsm|.vtu\n";
    return 2;
  }
  try
  {
    // Any mesh file becomes a mesh stream; one that is a stream already keeps its order.
    const auto mesh = smg::openMesh(argv[1]);
    smg::DescribedProblem problem(chipAndHeatSink(), mesh->reader().info());
    // Of all columns of the mesh, the problem needs those that it names.
    const auto source = [&]
    { return mesh->reader().source(problem.vertexColumns(), problem.cellColumns()); };
    problem.prepare(*source());

    smg::SolveOptions options;
    options.memoryLimit = std::int64_t(64) << 20;
    const auto solution = smg::solve(*source(), problem, options);

    smg::SolvedMesh solved(mesh->reader(), problem, *solution, { .gradient = true, .flux = true });
    for (const std::string& remark : smg::writeMesh(solved, argv[2]))
    {
      std::cout << remark << "\n";
    }
    smg::Report report = solution->report();
    solved.finish(report);
    print(report);
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
