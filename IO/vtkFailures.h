// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkType.h"
#include "vtkWeakPointer.h"

#include <string>

class vtkAlgorithm;
class vtkExecutive;

namespace smg
{

/**
 * The failures of an algorithm, each of which is shown once: a view asks several times for what
 * cannot be made, and the executive adds a message of its own to each answer that is 0.
 */
class Failures
{
public:
  /**
   * Makes the sentence an error of the algorithm, unless it was the last one and nothing in the
   * pipeline before the algorithm has been modified since. Who observes its errors hears them all.
   */
  void show(vtkAlgorithm& algorithm, const std::string& sentence);

  /** The algorithm has succeeded: its next failure is shown, whatever it is. */
  void clear() { this->Last.clear(); }

  /** Keeps the executive from saying, too, that the algorithm failed, where nobody observes it. */
  void quieten(vtkAlgorithm& algorithm);

private:
  std::string Last;
  vtkMTimeType PipelineTime = 0; ///< when it was shown
  vtkWeakPointer<vtkExecutive> Quiet;
};

} // namespace smg
