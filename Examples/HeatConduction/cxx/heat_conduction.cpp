// SPDX-License-Identifier: BSD-3-Clause
/*
Heat conduction in a chip and its heat sink, out of core, in C++ without VTK.

Two materials conduct heat: the ceramic of the chip with 25 W/(m K), the aluminium of the heat sink
with 200 W/(m K). The chip makes 50 MW/m^3, 19.6 W in all; 10 kW/m^2 leave through its solder, and
air of 20 degrees cools the heat sink with 50 W/(m^2 K). The sides of the chip are insulated. All
places are names that the mesher has given: see heat_sink.geo.

What this lesson shows:
 1. A problem is described in physical terms: conductivity, source, flux and heat transfer, each
with its place: a group of the mesh. The file heat.json states the same problem for the program smg.
 2. solve() evaluates the description on the mesh stream, and fails early if there is no such group.
 3. write() writes the mesh with the solution, and with the gradient and the flux in the cells,
block by block. The report that it completes contains the flow through each condition, the maximum
    temperature, and the balance of all flows.

Run it:

    heat_conduction ../../Data/heat_sink.msh heat.vtu

    1740 vertices, 5359 cells: converged after 8 cycles, relative residual 7.26129e-10
    peak: 77.748 degrees at vertex 515 of the file
    flux[0] (solder): -1.96 W into the body through 196 mm^2 of 76.5038 degrees
    robin[0] (air): -17.64 W into the body through 6980 mm^2 of 70.5444 degrees
    relative imbalance of all flows: 5.99067e-14
*/

#include <smg/Convert.h>
#include <smg/Solve.h>
#include <smg/SolvedMesh.h>

#include <iostream>

namespace
{

/** Lengths are in metres, as in the mesh. */
smg::ProblemDescription chipAndHeatSink()
{
  const smg::InGroup chip{ { "chip" } };
  smg::ProblemDescription heat;
  heat.conductivity = { { chip, 25.0 }, { smg::InGroup{ { "heat sink" } }, 200.0 } };
  heat.source = { { chip, 5e7 } };
  heat.flux = { { smg::InGroup{ { "solder" } }, -10000.0 } };
  heat.robin = { { smg::InGroup{ { "air" } }, 50.0, 20.0 } };
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
