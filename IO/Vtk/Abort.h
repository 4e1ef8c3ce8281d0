// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

// VTK 9.1 has only the flag of the algorithm itself; vtkAlgorithm::CheckAbort() came before the VTK
// of ParaView 5.11.
#define SMG_VTK_CHECKS_ABORT (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20230111))

namespace smg
{

/** Whether the algorithm is to stop; where VTK knows, also because one that it is a part of, or one
 * whose output it needs, is to. */
inline bool isAborted(vtkAlgorithm& algorithm)
{
#if SMG_VTK_CHECKS_ABORT
  // CheckAbort() alone does not look again after a SetAbortExecute(), which sets no time.
  return algorithm.GetAbortExecute() != 0 || algorithm.CheckAbort();
#else
  return algorithm.GetAbortExecute() != 0;
#endif
}

/** Ends the state of being aborted, so that the algorithm works when it is executed again. */
inline void endAbort(vtkAlgorithm& algorithm)
{
  algorithm.SetAbortExecute(0);
#if SMG_VTK_CHECKS_ABORT
  algorithm.SetAbortOutput(false);
#endif
}

} // namespace smg
