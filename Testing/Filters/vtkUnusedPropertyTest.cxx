// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshCondition.h"
#include "Filters/vtkStreamingMeshSmoothing.h"
#include "IO/Vtk/vtkStreamingMeshConverter.h"
#include "Testing/Filters/MeshHandleFixture.h"

#include "vtkSelection.h"
#include "vtkTrivialProducer.h"

#include <functional>
#include <string>
#include <vector>

// A property that has no effect with the others is said to have none, once.

namespace smg::testing
{
namespace
{

struct Setting
{
  std::string property;
  std::function<void()> set, choose; ///< without and with the mode in which it has an effect
  std::function<void()> reset = [] {};
};

/** Expects a warning that names the property once, and none with the mode or the default. */
void expectWarnings(vtkAlgorithm* filter, const std::vector<Setting>& settings)
{
  SCOPED_TRACE(filter->GetClassName());
  for (const Setting& setting : settings)
  {
    const std::string words = setting.property + " has no effect: ";
    const auto isWarned = [&]
    {
      Errors said(filter);
      filter->Modified();
      updatePiece(filter, 0, 1);
      return said.contain(words);
    };
    EXPECT_FALSE(isWarned()) << setting.property;
    setting.set();
    EXPECT_TRUE(isWarned()) << setting.property;
    EXPECT_FALSE(isWarned()) << setting.property << ": again";
    setting.choose();
    EXPECT_FALSE(isWarned()) << setting.property << ": with its mode";
    setting.reset();
  }
}

TEST_F(VtkMeshHandle, SaysThatAPropertyHasNoEffect)
{
  vtkMeshHandle& handle = *this->Handle;
  vtkNew<vtkTrivialProducer> selection;
  selection->SetOutput(vtkNew<vtkSelection>());
  const auto region = [&](int type) { return [&handle, type] { handle.SetRegion(type); }; };
  const auto similarity = [&] { handle.SetMotion(vtkMeshHandle::SIMILARITY); };
  const auto back = [&](const std::function<void()>& reset)
  {
    return [&handle, reset]
    {
      reset();
      handle.SetRegion(vtkMeshHandle::FUNCTION);
      handle.SetMotion(vtkMeshHandle::FIXED);
    };
  };
  expectWarnings(&handle,
    {
      { "RotationAngle", [&] { handle.SetRotationAngle(70.0); }, similarity,
        back([&] { handle.SetRotationAngle(0.0); }) },
      { "Scale", [&] { handle.SetScale(2.0); }, similarity, back([&] { handle.SetScale(1.0); }) },
      { "Translation", [&] { handle.SetTranslation(0.0, 1.0, 0.0); }, similarity,
        back([&] { handle.SetTranslation(0.0, 0.0, 0.0); }) },
      { "PointTargets", [&] { handle.AddPointTarget(0.0, 1.0, 0.0); },
        region(vtkMeshHandle::POINTS), back([&] { handle.RemoveAllPointTargets(); }) },
      { "Selection", [&] { handle.SetSelectionConnection(selection->GetOutputPort()); },
        region(vtkMeshHandle::SELECTION), back([&] { handle.SetSelectionConnection(nullptr); }) },
      { "Ids", [&] { handle.AddId(5); }, region(vtkMeshHandle::IDS),
        back([&] { handle.RemoveAllIds(); }) },
      { "Points", [&] { handle.AddPoint(0.0, 1.0, 0.0); }, region(vtkMeshHandle::POINTS),
        back([&] { handle.RemoveAllPoints(); }) },
      { "MaskArray", [&] { handle.SetMaskArray("a"); }, region(vtkMeshHandle::MASK),
        back([&] { handle.SetMaskArray("None"); }) },
      { "TagArray", [&] { handle.SetTagArray("a"); }, region(vtkMeshHandle::TAG),
        back([&] { handle.SetTagArray(nullptr); }) },
      { "Tag", [&] { handle.SetTag(3.0); }, region(vtkMeshHandle::TAG),
        back([&] { handle.SetTag(0.0); }) },
      { "IdType", [&] { handle.SetIdType(vtkMeshHandle::ORIGINAL_IDS); },
        region(vtkMeshHandle::IDS), back([&] { handle.SetIdType(vtkMeshHandle::GLOBAL_IDS); }) },
      { "Radius", [&] { handle.SetRadius(1.0); }, region(vtkMeshHandle::POINTS),
        back([&] { handle.SetRadius(-1.0); }) },
      { "Radius", [&] { handle.SetRadius(0.0); }, region(vtkMeshHandle::POINTS),
        back([&] { handle.SetRadius(-1.0); }) },
      { "Rings", [&] { handle.SetRings(2); }, region(vtkMeshHandle::IDS),
        back([&] { handle.SetRings(0); }) },
      { "InsideOut",
        [&]
        {
          handle.SetRegion(vtkMeshHandle::POINTS);
          handle.AddPoint(2.0, 0.0, 0.0);
          handle.SetInsideOut(true);
        },
        region(vtkMeshHandle::FUNCTION),
        back(
          [&]
          {
            handle.RemoveAllPoints();
            handle.SetInsideOut(false);
          }) },
    });
  handle.SetRegion(vtkMeshHandle::POINTS);
  handle.AddPoint(2.0, 0.0, 0.0);
  handle.AddPointTarget(2.0, 1.0, 0.0);
  expectWarnings(&handle, { { "Translation",
                            [&]
                            {
                              handle.SetMotion(vtkMeshHandle::SIMILARITY);
                              handle.SetTranslation(0.0, 1.0, 0.0);
                            },
                            [&] { handle.RemoveAllPointTargets(); } } });
}

TEST_F(VtkMeshHandle, AConditionSaysThatAPropertyHasNoEffect)
{
  vtkNew<vtkMeshCondition> owned;
  vtkMeshCondition& condition = *owned;
  condition.SetInputConnection(this->Reader->GetOutputPort());
  condition.SetRegion(vtkMeshCondition::EVERYWHERE);
  expectWarnings(&condition,
    {
      { "Coefficient", [&] { condition.SetCoefficient(2.0); },
        [&] { condition.SetCondition(vtkMeshCondition::SOFT); },
        [&] { condition.SetCoefficient(1.0); } },
      { "Value",
        [&]
        {
          condition.SetValue(2.0);
          condition.AddValue(3.0);
        },
        [&] { condition.RemoveAllValues(); } },
    });
}

TEST_F(VtkMeshHandle, ASolverSaysThatAPropertyHasNoEffect)
{
  vtkNew<vtkStreamingMeshSmoothing> smoothing;
  smoothing->SetInputConnection(this->Reader->GetOutputPort());
  expectWarnings(smoothing,
    {
      { "EdgeAngle", [&] { smoothing->SetEdgeAngle(45.0); }, [&] { smoothing->KeepEdgesOn(); },
        [&]
        {
          smoothing->KeepEdgesOff();
          smoothing->SetEdgeAngle(30.0);
        } },
    });
}

TEST_F(VtkMeshHandle, AConverterSaysThatADistanceHasNoEffect)
{
  vtkNew<vtkStreamingMeshConverter> converter;
  converter->SetFileName((this->Folder / "mesh.vsm").c_str());
  converter->SetOutputFileName((this->Folder / "out.vsm").c_str());
  Errors said(converter);
  ASSERT_TRUE(updatePiece(converter, 0, 1));
  EXPECT_EQ(said.text(), "");
  converter->SetWeldDistance(0.001);
  ASSERT_TRUE(updatePiece(converter, 0, 1));
  EXPECT_TRUE(said.contain("WeldDistance has no effect: turn Weld on")) << said.text();
  said.clear();
  converter->Modified();
  ASSERT_TRUE(updatePiece(converter, 0, 1));
  EXPECT_EQ(said.text(), "");
  converter->WeldOn();
  converter->OverwriteOn();
  ASSERT_TRUE(updatePiece(converter, 0, 1));
  EXPECT_FALSE(said.contain("has no effect")) << said.text();
}

} // namespace
} // namespace smg::testing
