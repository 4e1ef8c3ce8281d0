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

/** What an algorithm asks for could not be made by those before it, which have said why. */
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
  /**
   * Makes the sentence an error of the algorithm, unless it was the last one and nothing in the
   * pipeline before the algorithm has been modified since. Who observes its errors hears them all.
   */
  void show(vtkAlgorithm& algorithm, const std::string& sentence);

  /** Makes the sentence an error of the algorithm if somebody observes its errors. */
  void showToObservers(vtkAlgorithm& algorithm, const std::string& sentence);

  /** Keeps the executive from saying, too, that the algorithm failed, where nobody observes it. */
  void quieten(vtkAlgorithm& algorithm);

private:
  std::string Last;
  vtkMTimeType PipelineTime = 0; ///< when it was shown
  vtkWeakPointer<vtkExecutive> Quiet;
};

} // namespace smg
