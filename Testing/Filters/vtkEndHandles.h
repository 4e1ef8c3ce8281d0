// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/IO/PieceTesting.h"
#include "smg/Deform.h"
#include "smg/DeformationDescription.h"

#include "vtkDoubleArray.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace smg::testing
{

/** Holds both ends in x: the left one stays, the right one moves. */
struct EndHandles : public Handles
{
  double left = -2.5, right = 2.5;
  HandleMotion motion;
  double bad = 0.0; ///< added to the targets

  void hold(const double* point, std::uint8_t& mask, double* target, double* rotation,
    double& logScale) const
  {
    mask = point[0] <= this->left || point[0] >= this->right ? 1 : 0;
    std::copy_n(point, 3, target);
    std::fill_n(rotation, 3, 0.0);
    logScale = 0.0;
    if (point[0] >= this->right)
    {
      const auto moved = this->motion.apply(std::span<const double, 3>(point, 3));
      std::copy(moved.begin(), moved.end(), target);
      std::copy(this->motion.rotation().begin(), this->motion.rotation().end(), rotation);
      logScale = this->motion.logScale();
    }
    target[0] += this->bad;
  }

  void at(const MeshBlock& block, VertexHandles& handles) override
  {
    for (std::int64_t i = 0; i < block.vertices(); ++i)
    {
      this->hold(&block.positions[3 * i], handles.mask[i], &handles.target[3 * i],
        &handles.rotation[3 * i], handles.logScale[i]);
    }
  }
};

/** Makes the arrays of the handles like a Mesh Handle. */
class vtkEndHandles : public vtkPassInputTypeAlgorithm
{
public:
  static vtkEndHandles* New() { VTK_STANDARD_NEW_BODY(vtkEndHandles); }
  vtkTypeMacro(vtkEndHandles, vtkPassInputTypeAlgorithm);

  EndHandles Ends;
  int Executions = 0;
  bool CopiesMesh = false;       ///< makes new points and cells each time
  std::set<std::string> LeftOut; ///< arrays that are omitted
  int TargetComponents = 3;

  void move(const HandleMotion::Parameters& parameters)
  {
    this->Ends.motion = HandleMotion(parameters);
    this->Modified();
  }

protected:
  int RequestData(vtkInformation*, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    ++this->Executions;
    vtkPointSet* output = vtkPointSet::GetData(outputVector);
    vtkPointSet* input = vtkPointSet::GetData(inputVector[0]);
    if (this->CopiesMesh)
    {
      output->DeepCopy(input);
    }
    else
    {
      output->ShallowCopy(input);
    }
    const vtkIdType count = output->GetNumberOfPoints();
    vtkNew<vtkUnsignedCharArray> mask;
    mask->SetName(HandleMaskName);
    mask->SetNumberOfTuples(count);
    const auto target = make(HandleTargetName, this->TargetComponents, count);
    const auto rotation = make(HandleRotationName, 3, count);
    const auto logScale = make(HandleLogScaleName, 1, count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      double to[3];
      std::uint8_t held = 0;
      this->Ends.hold(
        output->GetPoint(i), held, to, rotation->GetPointer(3 * i), *logScale->GetPointer(i));
      mask->SetValue(i, held);
      std::copy_n(to, this->TargetComponents, target->GetPointer(this->TargetComponents * i));
    }
    for (vtkDataArray* array :
      { static_cast<vtkDataArray*>(mask.Get()), static_cast<vtkDataArray*>(target.Get()),
        static_cast<vtkDataArray*>(rotation.Get()), static_cast<vtkDataArray*>(logScale.Get()) })
    {
      if (this->LeftOut.count(array->GetName()) == 0)
      {
        output->GetPointData()->AddArray(array);
      }
    }
    return 1;
  }

private:
  static vtkSmartPointer<vtkDoubleArray> make(const char* name, int components, vtkIdType count)
  {
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(count);
    return array;
  }
};

} // namespace smg::testing
