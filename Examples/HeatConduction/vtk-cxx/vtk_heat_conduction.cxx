// SPDX-License-Identifier: BSD-3-Clause
/*
Heat conduction in a chip and its heat sink, out of core, in C++ with a VTK pipeline.

Two materials conduct heat: the ceramic of the chip with 25 W/(m K), the aluminium of the heat sink
with 200 W/(m K). The chip makes 50 MW/m^3, 19.6 W in all; 10 kW/m^2 leave through its solder, and
air of 20 degrees cools the heat sink with 50 W/(m^2 K). The sides of the chip are insulated. All
places are names that the mesher has given: see heat_sink.geo.

What this lesson shows:
 1. A condition is a filter: vtkMeshCondition sets a condition in a region, here in a group of the
    mesh. The filters are chained.
 2. vtkStreamingPoisson requests the mesh with these conditions in pieces, solves on scratch files,
    and delivers any piece with the solution and the flux in the cells. Its report contains the flow
    through each condition.
 3. vtkStreamingMeshWriter requests one piece after the other. The whole mesh is never in memory.

Run it:

    vtk_heat_conduction ../../Data/heat_sink.msh heat.vtu

    Converged after 8 V-cycles in 9 passes, relative residual 7.26e-10, to that of the best constant
    1740 vertices, 5359 cells
    peak: 77.748 degrees at vertex 515 of the file
    flux[0] (solder): -1.96 W into the body through 196 mm^2 of 76.5038 degrees
    robin[0] (air): -17.64 W into the body through 6980 mm^2 of 70.5444 degrees
    relative imbalance of all flows: 5.99067e-14
*/

#include "print_report.h"

#include "vtkMeshCondition.h"
#include "vtkStreamingMeshReader.h"
#include "vtkStreamingMeshWriter.h"
#include "vtkStreamingPoisson.h"

#include "vtkNew.h"

#include <iostream>

namespace
{

/** Appends a condition to the pipeline and sets its group, type and value. */
void say(
  vtkMeshCondition& condition, vtkAlgorithm* before, const char* group, int what, double value)
{
  condition.SetInputConnection(before->GetOutputPort());
  condition.SetRegion(vtkMeshCondition::GROUP);
  condition.SetGroupName(group);
  condition.SetCondition(what);
  condition.SetValue(value);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: vtk_heat_conduction MESH HEAT.vsm|.vtu\n";
    return 2;
  }
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(argv[1]);

  // Lengths are in metres, as in the mesh.
  vtkNew<vtkMeshCondition> ceramic;
  say(*ceramic, reader, "chip", vtkMeshCondition::CONDUCTIVITY, 25.0);
  vtkNew<vtkMeshCondition> aluminium;
  say(*aluminium, ceramic, "heat sink", vtkMeshCondition::CONDUCTIVITY, 200.0);
  vtkNew<vtkMeshCondition> power;
  say(*power, aluminium, "chip", vtkMeshCondition::SOURCE, 5e7);
  vtkNew<vtkMeshCondition> board;
  say(*board, power, "solder", vtkMeshCondition::FLUX, -10000.0);
  vtkNew<vtkMeshCondition> air;
  say(*air, board, "air", vtkMeshCondition::ROBIN, 20.0);
  air->SetCoefficient(50.0);

  vtkNew<vtkStreamingPoisson> poisson;
  poisson->SetInputConnection(air->GetOutputPort());
  poisson->GradientOn();
  poisson->FluxOn();
  poisson->SetMemoryLimit(64);

  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(poisson->GetOutputPort());
  writer->SetFileName(argv[2]);
  if (!writer->Write())
  {
    // The filters have reported the error.
    return 1;
  }

  std::cout << poisson->GetOutcome() << "\n";
  printReport(poisson->GetReport());
  return 0;
}
