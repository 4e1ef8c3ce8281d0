// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkStreamingMultigridIOModule.h" // For export macro

#include "smg/Error.h"

#include "vtkType.h"
#include "vtkWeakPointer.h"

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

/** Says in the field data that these data are empty since what should be here has failed; filters
 * pass it on. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void markAsFailed(vtkDataObject& data);
/** Whether they say so; null does not. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool isFailed(vtkDataObject* data);

/**
 * The failures of an algorithm, each of which is shown once: a view asks several times for what
 * cannot be made, and the executive adds a message of its own to each answer that is 0.
 */
class VTKSTREAMINGMULTIGRIDIO_EXPORT Failures
{
public:
  /** Reports the sentence as an error of the algorithm, unless it was the last one and the upstream
   * pipeline has not been modified since. Observers of its errors receive all of them. */
  void show(vtkAlgorithm& algorithm, const std::string& sentence);

  /** Reports the sentence as an error of the algorithm if its errors are observed. */
  void showToObservers(vtkAlgorithm& algorithm, const std::string& sentence);

  /** Suppresses the error message of the executive if it is not observed. */
  void quieten(vtkAlgorithm& algorithm);

private:
  std::string Last;
  vtkMTimeType PipelineTime = 0; ///< when the last one was shown
  vtkWeakPointer<vtkExecutive> Quiet;
};

} // namespace smg
