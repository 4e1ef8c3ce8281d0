// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/vtkPieceInput.h"

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace smg
{

/**
 * The state that results computed from an input depend on: they are valid while it is unchanged.
 */
struct InputStamp
{
  unsigned long long filter = 0; ///< modification time of the filter
  unsigned long long input = 0;  ///< modification time of the pipeline before it
  double time = 0.0;             ///< requested time step of a time-dependent input
  bool operator==(const InputStamp&) const = default;
};

/** The requested time if the input depends on time. */
inline double timeOf(vtkInformation* input)
{
  using vtkSDDP = vtkStreamingDemandDrivenPipeline;
  const bool hasTime = input->Has(vtkSDDP::TIME_STEPS()) || input->Has(vtkSDDP::TIME_RANGE());
  return hasTime && input->Has(vtkSDDP::UPDATE_TIME_STEP())
           ? input->Get(vtkSDDP::UPDATE_TIME_STEP())
           : 0.0;
}

/** The stamp of results of `filter` from its input, whose pipeline information is `info`. */
inline InputStamp stampOf(vtkAlgorithm& filter, PieceInput& input, vtkInformation* info)
{
  return { filter.GetMTime(), input.modifiedTime(), timeOf(info) };
}

} // namespace smg
