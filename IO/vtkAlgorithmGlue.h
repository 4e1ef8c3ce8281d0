// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/vtkFailures.h"
#include "IO/vtkStreamingMeshKeys.h"
#include "Solver/Core/Progress.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationStringVectorKey.h"
#include "vtkInformationVector.h"

#include <exception>

namespace smg
{

/** Tells the algorithm what is done of its work, and ends that when it is told to abort. */
inline ProgressFunction progressOf(vtkAlgorithm& algorithm)
{
  return [&algorithm](double done)
  {
    algorithm.UpdateProgress(done);
    return !algorithm.GetAbortExecute();
  };
}

/**
 * Says, in the information of an input port, that it takes meshes in pieces. Data sets of several
 * blocks are let in, too, so that PieceInput can refuse them: the executive would go through their
 * blocks, and to ask for pieces meanwhile would take these away from it.
 */
inline void acceptMeshes(vtkInformation& info)
{
  info.Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info.Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  info.Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
}

/** Says, in RequestInformation, that the algorithm answers requests for pieces. */
inline int offerPieces(vtkInformationVector& outputs)
{
  outputs.GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

/**
 * Does the work of RequestData: 1. What is thrown becomes an error of the algorithm, which is shown
 * once; of a failed input nothing more is said than has been. The answer to a
 * streamed request, which somebody made who looks at it, is 0 then, and it is tried again whenever
 * that is asked for. Any other request gets an empty output that says so (isFailed()), and 1: views
 * of ParaView that get 0 never ask again. If it is Cancelled, nothing is reported, the answer is 0,
 * and nothing is done again before the algorithm or its input is modified.
 * `inputs`: null if there are none.
 */
template <class Work>
int answer(vtkAlgorithm& algorithm, Failures& failures, vtkInformationVector** inputs,
  vtkInformationVector& outputs, Work work)
{
  vtkInformation* output = outputs.GetInformationObject(0);
  try
  {
    if (inputs && isFailed(vtkDataObject::GetData(inputs[0])))
    {
      throw InputFailed("The input has failed: see the error of the filter before this one.");
    }
    work();
    return 1;
  }
  catch (const Cancelled&)
  {
    algorithm.SetAbortExecute(0);
    failures.quieten(algorithm);
    return 0;
  }
  catch (const InputFailed& error)
  {
    failures.showToObservers(algorithm, error.what());
  }
  catch (const std::exception& error)
  {
    failures.show(algorithm, error.what());
  }
  vtkDataObject* data = vtkDataObject::GetData(output);
  if (vtkStreamingMeshKeys::IsStreamed(output))
  {
    // Else the executive would go on with what there is.
    data->ReleaseData();
    output->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
    return 0;
  }
  data->Initialize();
  markAsFailed(*data);
  return 1;
}

} // namespace smg
