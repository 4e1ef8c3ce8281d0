// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Vtk/Abort.h"
#include "IO/Vtk/SingleBlock.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "Solver/Core/Progress.h"
#include "smg/Error.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationStringVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkStreamingMultigridIOModule.h"
#include "vtkTimeStamp.h"
#include "vtkType.h"
#include "vtkWeakPointer.h"

#include <exception>
#include <string>

class vtkExecutive;

namespace smg
{

/** An upstream algorithm has failed and has reported the reason. */
class InputFailed : public Error
{
public:
  using Error::Error;
};

/** An upstream algorithm has been aborted, of which nobody reports anything. */
class InputCancelled : public InputFailed
{
public:
  using InputFailed::InputFailed;
};

/** The field array of data that are empty because of a failure. */
inline constexpr const char* FailedName = "Failed";
inline constexpr int FailedComponents = 19;
/** Marks the data as such; filters pass the mark, by which the plugin chooses the writer. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void markAsFailed(vtkDataObject& data);
/** Whether the data are marked as failed; false for null. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool isFailed(vtkDataObject* data);

/** Gives a mesh without points or cells empty arrays of these: filters of VTK look at them without
 * asking whether they exist. Other data are left alone. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void completeMesh(vtkDataObject& data);

/** The failures of an algorithm, each of which is shown once: a view repeats failing requests, and
 * the executive adds its own message whenever 0 is returned. */
class VTKSTREAMINGMULTIGRIDIO_EXPORT Failures
{
public:
  Failures() = default;
  ~Failures();
  Failures(const Failures&) = delete;
  Failures& operator=(const Failures&) = delete;

  /** To be called when the algorithm begins: there is no error yet. */
  void begin();
  /** The sentence of the last failure since then, shown or not; empty: none. */
  const std::string& error() const { return this->Error; }

  /** Notes that a request has been answered or has failed, with all modifications that this itself
   * caused. */
  void noteEnd() { this->Ended.Modified(); }
  /** Whether the algorithm has been executed, and neither it nor what is before it has been
   * modified since, as far as the pipeline knows. An algorithm behind another that fails may not be
   * executed at all. What it says of its last request goes with that. */
  bool isLast(vtkAlgorithm& algorithm) const;
  /** The same, and the request has been answered: what it says of its result goes with that. */
  bool isCurrent(vtkAlgorithm& algorithm) const
  {
    return this->Error.empty() && this->isLast(algorithm);
  }

  /** Reports the sentence as an error of the algorithm, unless it was the last one and the upstream
   * pipeline has not been modified since. Observers of its errors receive all of them. */
  void show(vtkAlgorithm& algorithm, const std::string& sentence);

  /** Reports the sentence as an error of the algorithm if its errors are observed. */
  void reportToObservers(vtkAlgorithm& algorithm, const std::string& sentence);

  /** Returns 0, the answer of the algorithm to a request that has failed. The error that the
   * executive then adds is not displayed, unless it is observed. */
  int refuse(vtkAlgorithm& algorithm);

private:
  static void display(vtkObject* executive, unsigned long event, void* self, void* text);
  void watch(vtkExecutive* executive);

  std::string Error;
  vtkTimeStamp Ended;
  std::string Last;              ///< that was shown
  vtkMTimeType PipelineTime = 0; ///< when the last one was shown
  /** Receives the errors of the executive. */
  vtkNew<vtkCallbackCommand> OfExecutive;
  vtkWeakPointer<vtkExecutive> Watched;
  bool IsRefused = false; ///< whether the next error of the executive is about an answer of 0
};

/** Reports progress to the algorithm and cancels the work if the algorithm is aborted. */
inline ProgressFunction progressOf(vtkAlgorithm& algorithm)
{
  return [&algorithm](double done)
  {
    algorithm.UpdateProgress(done);
    return !isAborted(algorithm);
  };
}

/**
 * Declares, in the information of an input port, that it accepts meshes in pieces. Composite data
 * sets are accepted as well, so that PieceInput can take the single block with cells of one:
 * otherwise the executive would iterate over the blocks, and requesting pieces meanwhile would
 * release these.
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

/** Ends the abort of an algorithm, and returns the answer to the request: nothing is reported. */
inline int cancel(vtkAlgorithm& algorithm, Failures& failures)
{
  endAbort(algorithm);
  algorithm.GetInformation()->Set(vtkStreamingMeshKeys::CANCELLED(), 1);
  return failures.refuse(algorithm);
}

/**
 * Runs the work of RequestData and returns 1. An exception becomes an error of the algorithm, which
 * is shown once; a failed input causes no further message. A streamed request, whose consumer
 * checks the result, then returns 0 and is repeated whenever it is requested. Any other request
 * then returns 1 with an empty output marked as failed (isFailed()), since ParaView views never
 * repeat a request that returned 0. If the work throws Cancelled, nothing is reported, 0 is
 * returned, and the work is not repeated until the algorithm or its input is modified. `inputs` is
 * null if there are none. Whatever happens, the output is complete: see completeMesh(). While the
 * work is done, the output for an input of several blocks is a mesh: see throughSingleBlock().
 */
template <class Work>
int runRequestData(vtkAlgorithm& algorithm, Failures& failures, vtkInformationVector** inputs,
  vtkInformationVector& outputs, Work work)
{
  vtkInformation* output = outputs.GetInformationObject(0);
  vtkDataObject* input = inputs ? vtkDataObject::GetData(inputs[0]) : nullptr;
  vtkDataObject* data = vtkDataObject::GetData(output);
  failures.begin();
  algorithm.GetInformation()->Remove(vtkStreamingMeshKeys::CANCELLED());
  try
  {
    if (isFailed(input))
    {
      throw InputFailed("The input has failed: see the error of the filter before this one.");
    }
    throughSingleBlock(input, *output, work);
    completeMesh(*data);
    failures.noteEnd();
    return 1;
  }
  catch (const Cancelled&)
  {
    data->Initialize();
    completeMesh(*data);
    return cancel(algorithm, failures);
  }
  catch (const InputFailed& error)
  {
    failures.reportToObservers(algorithm, error.what());
  }
  catch (const std::exception& error)
  {
    failures.show(algorithm, error.what());
  }
  failures.noteEnd();
  if (vtkStreamingMeshKeys::IsStreamed(output))
  {
    // Otherwise the executive would continue with the current data.
    data->ReleaseData();
    completeMesh(*data);
    output->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
    return failures.refuse(algorithm);
  }
  data->Initialize();
  completeMesh(*data);
  markAsFailed(*data);
  return 1;
}

} // namespace smg
