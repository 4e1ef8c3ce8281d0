// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include "vtkAlgorithm.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

namespace smg::testing
{

/** What a filter writes for the two vertices of no cell of a mesh that the reader then reads, which
 * is made in the folder. */
inline IsolatedVertices writtenAtLoosePoints(
  const TemporaryFolder& folder, vtkStreamingMeshReader& reader, vtkAlgorithm& filter)
{
  IndexedTestMesh mesh = grid(6, 6);
  mesh.positions.insert(mesh.positions.end(), { 1, 2, 3, 4, 5, 6 });
  writeBytes(folder / "loose.off", meshText(mesh));
  convert(folder / "loose.off", folder / "loose.vsm");
  reader.SetFileName((folder / "loose.vsm").c_str());
  const vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(filter.GetOutputPort());
  writer->SetFileName((folder / "out.vsm").c_str());
  EXPECT_TRUE(writer->Write());
  VsmReader written(folder / "out.vsm");
  IsolatedVertices loose;
  written.readIsolated(0, written.isolatedVertices(), loose);
  EXPECT_EQ(loose.ids.size(), 2U);
  return loose;
}

} // namespace smg::testing
