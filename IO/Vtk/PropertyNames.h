// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkStreamingMultigridIOModule.h"

#include <string>
#include <string_view>

class vtkAlgorithm;

namespace smg
{

/** The property that does what an option of the program smg does, as "--memory"; empty: none. */
VTKSTREAMINGMULTIGRIDIO_EXPORT std::string_view propertyOf(std::string_view option);

/** A sentence of the libraries with properties instead of options of smg, for what an algorithm
 * shows, as panels show them: "(property Memory Limit)" for "(option --memory)", "Region Name" for
 * "RegionName", and counts as "34,834 points". */
VTKSTREAMINGMULTIGRIDIO_EXPORT std::string withProperties(
  std::string sentence, vtkAlgorithm& algorithm);

} // namespace smg
