// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/vtkStreamingMeshKeys.h"
#include "Solver/Core/Progress.h"
#include "smg/Error.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationStringVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingMultigridIOModule.h"
#include "vtkType.h"
#include "vtkWeakPointer.h"

#include <exception>
#include <string>

class vtkAlgorithm;
class vtkDataObject;
class vtkExecutive;

namespace smg
{

/** An upstream algorithm has failed and has reported the reason. */
class InputFailed : public Error
{
public:
  using Error::Error;
};

/** Marks the data, in their field data, as empty because of a failure; filters pass the mark. The
 * writers of the plugin know it by the number of its components. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void markAsFailed(vtkDataObject& data);
/** Whether the data are marked as failed; false for null. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool isFailed(vtkDataObject* data);

/** The failures of an algorithm, each of which is shown once: a view repeats failing requests, and
 * the executive adds its own message whenever 0 is returned. */
class VTKSTREAMINGMULTIGRIDIO_EXPORT Failures
{
public:
  /** To be called when the algorithm begins: there is no error yet. */
  void begin() { this->Error.clear(); }
  /** The sentence of the last failure since then, shown or not; empty: none. */
  const std::string& error() const { return this->Error; }

  /** Reports the sentence as an error of the algorithm, unless it was the last one and the upstream
   * pipeline has not been modified since. Observers of its errors receive all of them. */
  void show(vtkAlgorithm& algorithm, const std::string& sentence);

  /** Reports the sentence as an error of the algorithm if its errors are observed. */
  void showToObservers(vtkAlgorithm& algorithm, const std::string& sentence);

  /** Suppresses the error message of the executive if it is not observed. */
  void quieten(vtkAlgorithm& algorithm);

private:
  std::string Error;
  std::string Last;              ///< that was shown
  vtkMTimeType PipelineTime = 0; ///< when the last one was shown
  vtkWeakPointer<vtkExecutive> Quiet;
};

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
