// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/vtkFailures.h"
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

/** Lets the executive ask again the next time, whereas it would go on with empty outputs. */
inline void leaveUndone(vtkInformationVector& outputs)
{
  for (int port = 0; port < outputs.GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* info = outputs.GetInformationObject(port);
    if (vtkDataObject* data = vtkDataObject::GetData(info))
    {
      data->ReleaseData();
    }
    info->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
}

/**
 * Does the work of RequestData: 1. What is thrown becomes an error of the algorithm, which is shown
 * once, and the answer is 0. If it is Cancelled, nothing is reported, and nothing is done again
 * before the algorithm or its input is modified.
 */
template <class Work>
int answer(vtkAlgorithm& algorithm, Failures& failures, vtkInformationVector& outputs, Work work)
{
  try
  {
    work();
    failures.clear();
    return 1;
  }
  catch (const Cancelled&)
  {
    algorithm.SetAbortExecute(0);
    failures.quieten(algorithm);
  }
  catch (const std::exception& error)
  {
    failures.show(algorithm, error.what());
    leaveUndone(outputs);
  }
  return 0;
}

} // namespace smg
