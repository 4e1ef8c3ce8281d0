// SPDX-License-Identifier: BSD-3-Clause
/*
Heat conduction in a chip and its heat sink, out of core, in C++ without VTK.

Two materials conduct heat: the ceramic of the chip with 25 W/(m K), the aluminium of the heat sink
with 200 W/(m K). Heat flows in through the bottom of the chip with 100 kW/m^2; air of 20 degrees
cools the top of the plate and the fins with 100 W/(m^2 K). All other surfaces are insulated.

What this lesson shows:
 1. A problem is described in physical terms: conductivity, flux and heat transfer, each with its
    place: cells by a column of the mesh, boundary facets by regions. A facet is in a region if all
    its corners are. The file heat.json states the same problem for the program smg.
 2. solve() evaluates the description on the mesh stream, and fails early if a selection is empty.
 3. write() writes the mesh with the solution, and with the gradient and the flux in the cells,
block by block. The report that it completes contains the flow through each condition, the maximum
    temperature, and the balance of all flows.

Run it:

    heat_conduction ../../Data/heat_sink.vtk heat.vtu

    2116 vertices, 6822 cells: converged after 8 cycles, relative residual 6.84237e-09
    peak: 67.8414 degrees at vertex 36 of the file
    flux[0]: 19.6 W into the body through 196 mm^2 of 67.2205 degrees
    robin[0]: -19.6 W into the body through 5476 mm^2 of 55.7925 degrees
    relative imbalance of all flows: 1.69165e-11
*/

#include <smg/Convert.h>
#include <smg/Solve.h>
#include <smg/SolvedMesh.h>

#include <iostream>

namespace
{

/** Lengths are in metres; z points up, from the chip to the fins. */
smg::ProblemDescription chipAndHeatSink()
{
  const smg::Region bottom = smg::halfSpace({ 0, 0, -1 }, -0.001); // z <= 1 mm
  const smg::Region air = smg::halfSpace({ 0, 0, 1 }, 0.005);      // z >= 5 mm

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
  std::cout << "relative imbalance of all flows: " << report.balance[0] << "\n";
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
    // Any mesh file is converted to a mesh stream; a stream keeps its order.
    const auto mesh = smg::openMesh(argv[1]);
    const smg::ProblemDescription heat = chipAndHeatSink();
    const auto solution = smg::solve(*mesh, heat, { .memoryLimit = 64 * smg::MiB });
    print(smg::write(*mesh, heat, *solution, argv[2]));
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
