// SPDX-License-Identifier: BSD-3-Clause
/*
Heat conduction in a chip and its heat sink, out of core, in C++ with a VTK pipeline.

Two materials conduct heat: the ceramic of the chip with 25 W/(m K), the aluminium of the heat sink
with 200 W/(m K). Heat flows in through the bottom of the chip with 100 kW/m^2; air of 20 degrees
cools the top of the plate and the fins with 100 W/(m^2 K). All other surfaces are insulated.

What this lesson shows:
 1. A condition is a filter: vtkMeshCondition sets a condition in a region: in cells by an array of
    the mesh, on boundary facets by an implicit function. A facet is in a region if all its corners
    are. The filters are chained.
 2. vtkStreamingPoisson requests the mesh with these conditions in pieces, solves on scratch files,
    and delivers any piece with the solution and the flux in the cells. Its report contains the flow
    through each condition.
 3. vtkStreamingMeshWriter requests one piece after the other. The whole mesh is never in memory.

Run it:

    vtk_heat_conduction ../../Data/heat_sink.vtk heat.vtu

    Converged after 8 V-cycles in 9 passes, relative residual 6.84e-09, to that of the best constant
    2116 vertices, 6822 cells
    peak: 67.8414 degrees at vertex 36 of the file
    flux[0]: 19.6 W into the body through 196 mm^2 of 67.2205 degrees
    robin[0]: -19.6 W into the body through 5476 mm^2 of 55.7925 degrees
    relative imbalance of all flows: 1.69165e-11
*/

#include "print_report.h"

#include "vtkMeshCondition.h"
#include "vtkStreamingMeshReader.h"
#include "vtkStreamingMeshWriter.h"
#include "vtkStreamingPoisson.h"

#include "vtkNew.h"
#include "vtkPlane.h"

#include <iostream>

namespace
{

/** Appends a condition to the pipeline and sets its type and value. */
void say(vtkMeshCondition& condition, vtkAlgorithm* before, int what, double value)
{
  condition.SetInputConnection(before->GetOutputPort());
  condition.SetCondition(what);
  condition.SetValue(value);
}

/** Sets the region to one side of a height: the side opposite to the normal (0, 0, up). */
void bound(vtkMeshCondition& condition, double height, double up)
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.0, 0.0, height);
  plane->SetNormal(0.0, 0.0, up);
  condition.SetRegion(vtkMeshCondition::FUNCTION);
  condition.SetRegionFunction(plane);
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

  // Lengths are in metres; z points up, from the chip to the fins.
  vtkNew<vtkMeshCondition> ceramic;
  say(*ceramic, reader, vtkMeshCondition::CONDUCTIVITY, 25.0);
  ceramic->SetRegion(vtkMeshCondition::EVERYWHERE);
  vtkNew<vtkMeshCondition> aluminium;
  say(*aluminium, ceramic, vtkMeshCondition::CONDUCTIVITY, 200.0);
  aluminium->SetRegion(vtkMeshCondition::TAG);
  aluminium->SetTagArray("Material");
  aluminium->SetTag(2);
  vtkNew<vtkMeshCondition> heating;
  say(*heating, aluminium, vtkMeshCondition::FLUX, 100000.0);
  bound(*heating, 0.001, 1.0);
  vtkNew<vtkMeshCondition> air;
  say(*air, heating, vtkMeshCondition::ROBIN, 20.0);
  air->SetCoefficient(100.0);
  bound(*air, 0.005, -1.0);

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
