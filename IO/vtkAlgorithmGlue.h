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

/** Reports progress to the algorithm and cancels the work if the algorithm is aborted. */
inline ProgressFunction progressOf(vtkAlgorithm& algorithm)
{
  return [&algorithm](double done)
  {
    algorithm.UpdateProgress(done);
    return !algorithm.GetAbortExecute();
  };
}

/**
 * Declares, in the information of an input port, that it accepts meshes in pieces. Composite data
 * sets are accepted as well, so that PieceInput can reject them: otherwise the executive would
 * iterate over their blocks, and requesting pieces meanwhile would release these.
 */
inline void acceptMeshes(vtkInformation& info)
{
  info.Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info.Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  info.Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
}

/** Declares, in RequestInformation, that the algorithm handles piece requests. */
inline int offerPieces(vtkInformationVector& outputs)
{
  outputs.GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

/**
 * Runs the work of RequestData and returns 1. An exception becomes an error of the algorithm, which
 * is shown once; a failed input causes no further message. A streamed request, whose consumer
 * checks the result, then returns 0 and is repeated whenever it is requested. Any other request
 * then returns 1 with an empty output marked as failed (isFailed()), since ParaView views never
 * repeat a request that returned 0. If the work throws Cancelled, nothing is reported, 0 is
 * returned, and the work is not repeated until the algorithm or its input is modified. `inputs` is
 * null if there are none.
 */
template <class Work>
int answer(vtkAlgorithm& algorithm, Failures& failures, vtkInformationVector** inputs,
  vtkInformationVector& outputs, Work work)
{
  vtkInformation* output = outputs.GetInformationObject(0);
  failures.begin();
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
    // Otherwise the executive would continue with the current data.
    data->ReleaseData();
    output->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
    return 0;
  }
  data->Initialize();
  markAsFailed(*data);
  return 1;
}

} // namespace smg
