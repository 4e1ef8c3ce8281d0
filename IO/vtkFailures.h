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

} // namespace smg
