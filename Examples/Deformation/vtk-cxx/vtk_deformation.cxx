// SPDX-License-Identifier: BSD-3-Clause
/*
The Stanford bunny turns its head, out of core, in C++ with a VTK pipeline.

Its base is held where it is, its head turned by 70 degrees and scaled by 1.3, an ear turned by 90
degrees; the rest of the mesh follows and keeps its details. What is held and how it moves stands in
a handle file, the same that the program smg takes: smg deform MESH OUT --handles bunny.json.

What this lesson shows:
 1. A handle is a filter: vtkMeshHandle takes hold of the points where an implicit function is at
    most 0, and says where they go in point arrays. One filter follows the other.
 2. vtkStreamingMeshDeformation pulls the mesh with these arrays in pieces, solves on scratch files,
    and serves the deformed mesh with any piece.
 3. vtkStreamingMeshWriter asks for piece after piece. So never is the whole mesh in memory.

Run it:

    vtk_deformation ../../Data/bunny.smb ../bunny.json bunny-deformed.vsm

    34834 points: converged in 14 passes, relative residual 5.50654e-07
*/

#include "vtkMeshHandle.h"
#include "vtkStreamingMeshDeformation.h"
#include "vtkStreamingMeshReader.h"
#include "vtkStreamingMeshWriter.h"

#include "vtkBox.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkSmartPointer.h"
#include "vtkSphere.h"

#include <nlohmann/json.hpp>

#include <array>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <vector>

namespace
{

using Json = nlohmann::json;
using Vector = std::array<double, 3>;

/** Lets the handle hold a region of the file; answers the middle of spheres and boxes. */
Vector setRegion(vtkMeshHandle& handle, const Json& region)
{
  if (region.contains("vertices"))
  {
    handle.SetRegion(vtkMeshHandle::IDS);
    handle.SetIdType(vtkMeshHandle::ORIGINAL_IDS);
    for (const Json& id : region["vertices"])
    {
      handle.AddId(id.get<vtkIdType>());
    }
    return {};
  }
  const auto n = region.front().get<std::vector<double>>();
  if (region.contains("sphere"))
  {
    vtkNew<vtkSphere> sphere;
    sphere->SetCenter(n.at(0), n.at(1), n.at(2));
    sphere->SetRadius(n.at(3));
    handle.SetRegionFunction(sphere);
    return { n[0], n[1], n[2] };
  }
  if (region.contains("box"))
  {
    vtkNew<vtkBox> box;
    box->SetXMin(n.at(0), n.at(1), n.at(2));
    box->SetXMax(n.at(3), n.at(4), n.at(5));
    handle.SetRegionFunction(box);
    return { (n[0] + n[3]) / 2, (n[1] + n[4]) / 2, (n[2] + n[5]) / 2 };
  }
  // A half-space: n x >= d. Inside of a plane is the side away from its normal.
  const auto half = region.at("halfspace").get<std::array<double, 4>>();
  const double scale = half[3] / (half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
  vtkNew<vtkPlane> plane;
  plane->SetNormal(-half[0], -half[1], -half[2]);
  plane->SetOrigin(scale * half[0], scale * half[1], scale * half[2]);
  handle.SetRegionFunction(plane);
  return {};
}

/** Rotation and scale about the centre, then translation. */
void setMotion(vtkMeshHandle& handle, const Json& entry, const Vector& middle)
{
  const Json rotate = entry.value("rotate", Json::object());
  handle.SetMotion(vtkMeshHandle::SIMILARITY);
  handle.SetRotationAxis(rotate.value("axis", Vector{ 0.0, 0.0, 1.0 }).data());
  handle.SetRotationAngle(rotate.value("degrees", 0.0));
  handle.SetCenter(rotate.value("center", entry.value("center", middle)).data());
  handle.SetScale(entry.value("scale", 1.0));
  handle.SetTranslation(entry.value("translate", Vector{}).data());
}

/** One handle after the other; the last one has them all. */
vtkSmartPointer<vtkAlgorithm> takeHandles(vtkAlgorithm* mesh, const Json& handles)
{
  vtkSmartPointer<vtkAlgorithm> last = mesh;
  for (const Json& entry : handles)
  {
    vtkNew<vtkMeshHandle> handle;
    handle->SetInputConnection(last->GetOutputPort());
    const Vector middle = setRegion(*handle, entry.at("region"));
    if (!entry.value("fixed", false))
    {
      setMotion(*handle, entry, middle);
    }
    last = handle;
  }
  return last;
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 4)
  {
    std::cerr << "usage: vtk_deformation MESH HANDLES.json DEFORMED.vsm|.ply|.vtp|.vtu\n";
    return 2;
  }
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(argv[1]);
  vtkNew<vtkStreamingMeshDeformation> deformation;
  deformation->SetMemoryLimit(128);
  try
  {
    std::ifstream in(argv[2]);
    if (!in)
    {
      throw std::runtime_error("cannot be opened");
    }
    const Json file = Json::parse(in);
    deformation->SetInputConnection(takeHandles(reader, file.at("handles"))->GetOutputPort());
    const std::string weights = file.value("weights", "clamped");
    deformation->SetWeights(weights == "uniform"     ? vtkStreamingMeshDeformation::UNIFORM
                            : weights == "cotangent" ? vtkStreamingMeshDeformation::COTANGENT
                                                     : vtkStreamingMeshDeformation::CLAMPED);
    deformation->SetCycles(file.value("cycles", deformation->GetCycles()));
    deformation->SetTolerance(file.value("tolerance", deformation->GetTolerance()));
  }
  catch (const std::exception& error)
  {
    std::cerr << argv[2] << ": " << error.what() << "\n";
    return 1;
  }

  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(deformation->GetOutputPort());
  writer->SetFileName(argv[3]);
  if (!writer->Write())
  {
    // The filters have said what is wrong.
    return 1;
  }
  std::cout << reader->GetFullNumberOfPoints()
            << " points: " << (deformation->GetConverged() ? "converged" : "not converged")
            << " in " << deformation->GetPasses() << " passes, relative residual "
            << deformation->GetResidual() << "\n";
  return 0;
}
