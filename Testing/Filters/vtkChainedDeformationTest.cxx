// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Filters/DeformationFixture.h"

#include "vtkPoints.h"

namespace smg::testing
{
namespace
{

/** The input, moved along x by the time. */
class vtkMovingMesh : public vtkPassInputTypeAlgorithm
{
public:
  static vtkMovingMesh* New() { VTK_STANDARD_NEW_BODY(vtkMovingMesh); }
  vtkTypeMacro(vtkMovingMesh, vtkPassInputTypeAlgorithm);

protected:
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    const double steps[] = { 0.0, 0.125, 0.25 };
    const double range[] = { 0.0, 0.25 };
    vtkInformation* info = outputVector->GetInformationObject(0);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), steps, 3);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    vtkInformation* info = outputVector->GetInformationObject(0);
    const double time = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    vtkPointSet* output = vtkPointSet::GetData(info);
    output->ShallowCopy(vtkPointSet::GetData(inputVector[0]));
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->DeepCopy(output->GetPoints());
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
    {
      const double* point = points->GetPoint(i);
      points->SetPoint(i, point[0] + time, point[1], point[2]);
    }
    output->SetPoints(points);
    return 1;
  }
};

using VtkChainedDeformation = DeformationFixture;

TEST_F(VtkChainedDeformation, ASecondOneDeformsWhatTheFirstMakes)
{
  vtkNew<vtkEndHandles> handles;
  handles->SetInputConnection(this->Deformation->GetOutputPort());
  handles->Ends.right = 2.0;
  handles->move({ .translation = { 0.0, -0.5, 0.0 } });
  vtkNew<vtkStreamingMeshDeformation> second;
  second->SetInputConnection(handles->GetOutputPort());
  second->SetNumberOfPieces(4);
  const auto collect = [&](int pieces)
  {
    PieceUnion all;
    for (int piece = 0; piece < pieces; ++piece)
    {
      EXPECT_TRUE(updatePiece(second, piece, pieces));
      all.add(vtkPointSet::SafeDownCast(second->GetOutputDataObject(0)), piece);
    }
    return all;
  };
  const PieceUnion inMemory = collect(1);
  StreamMesh expected = this->deformed(this->Mesh);
  MemorySource source(expected);
  EndHandles ends = handles->Ends;
  DeformOptions options;
  options.inCore = true;
  std::vector<double> positions(expected.positions.size());
  deform(source, ends, options)->read(0, expected.vertices(), positions);
  expected.positions = positions;
  inMemory.expectEqual(expected);
  // Each streams from the one before.
  this->Deformation->SetInteractivePoints(0);
  second->SetInteractivePoints(0);
  collect(1).expectEqual(expected);
  collect(3).expectEqual(expected);
}

TEST_F(VtkChainedDeformation, EachTimeHasItsOwn)
{
  vtkNew<vtkMovingMesh> moving;
  moving->SetInputConnection(this->Reader->GetOutputPort());
  this->Handles->SetInputConnection(moving->GetOutputPort());
  for (const vtkIdType interactive : { 200000, 0 })
  {
    this->Deformation->SetInteractivePoints(interactive);
    for (const double time : { 0.0, 0.25, 0.0 })
    {
      StreamMesh mesh = this->Mesh;
      for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
      {
        mesh.positions[i] += time;
      }
      this->Deformation->UpdateTimeStep(time);
      PieceUnion whole;
      whole.add(this->output(), 0);
      whole.expectEqual(this->deformed(mesh));
    }
  }
}

} // namespace
} // namespace smg::testing
