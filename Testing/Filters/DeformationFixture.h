// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/vtkStreamingMeshDeformation.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Testing/Filters/vtkEndHandles.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Deform.h"

#include <string>

namespace smg::testing
{

/** Deforms a torus whose ends are held. */
class DeformationFixture : public ::testing::Test
{
protected:
  DeformationFixture()
  {
    this->open(torus(60, 30, 0.2));
    this->Handles->SetInputConnection(this->Reader->GetOutputPort());
    this->prepare(this->Deformation);
    this->Handles->move(this->Turn);
  }

  void open(const IndexedTestMesh& mesh)
  {
    const std::string name = "mesh" + std::to_string(this->Folder.entries()) + ".vsm";
    this->Mesh = writeVsm(this->Folder / name, mesh);
    this->Reader->SetFileName((this->Folder / name).c_str());
  }

  void prepare(vtkStreamingMeshDeformation* deformation)
  {
    deformation->SetInputConnection(this->Handles->GetOutputPort());
    deformation->SetNumberOfPieces(5);
    deformation->SetScratchDirectory(this->Folder.path().c_str());
  }

  vtkPointSet* output()
  {
    return vtkPointSet::SafeDownCast(this->Deformation->GetOutputDataObject(0));
  }

  PieceUnion collectPieces(int pieces)
  {
    PieceUnion all;
    for (int piece = 0; piece < pieces; ++piece)
    {
      EXPECT_TRUE(updatePiece(this->Deformation, piece, pieces));
      all.add(this->output(), piece);
    }
    return all;
  }

  /** The mesh with the positions that deform() computes for the handles. */
  StreamMesh deformed(const StreamMesh& mesh) const
  {
    StreamMesh result = mesh;
    MemorySource source(mesh);
    EndHandles handles = this->Handles->Ends;
    DeformOptions options;
    options.cycles = this->Deformation->GetCycles();
    options.inCore = true;
    deform(source, handles, options)->read(0, mesh.vertices(), result.positions);
    return result;
  }

  const HandleMotion::Parameters Turn{ .translation = { 0.5, 0.1, 0.3 },
    .axis = { 1.0, 0.0, 0.0 },
    .degrees = 70.0,
    .center = { 3.0, 0.0, 0.0 },
    .scale = 1.2 };
  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkEndHandles> Handles;
  vtkNew<vtkStreamingMeshDeformation> Deformation;
};

} // namespace smg::testing
