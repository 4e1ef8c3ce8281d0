// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Vtk/Abort.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPointSet.h"

#include <functional>
#include <vector>

namespace smg::testing
{

/** A way to abort a filter, and to end that. */
struct WayToAbort
{
  std::function<void()> abort, end;
};

/** By itself and, where VTK knows that, by an algorithm that it is a part of. */
inline std::vector<WayToAbort> waysToAbort(
  vtkAlgorithm* filter, [[maybe_unused]] vtkAlgorithm* whole)
{
  std::vector<WayToAbort> ways{ { [filter] { filter->SetAbortExecute(1); },
    [filter] { filter->SetAbortExecute(0); } } };
#if SMG_VTK_CHECKS_ABORT
  ways.push_back({ [filter, whole]
    {
      filter->SetContainerAlgorithm(whole);
      whole->SetAbortExecuteAndUpdateTime();
    },
    [filter, whole]
    {
      whole->SetAbortExecute(0);
      filter->SetContainerAlgorithm(nullptr);
      filter->Modified(); // else the aborted work is not repeated
    } });
#endif
  return ways;
}

/** Aborts a filter at its first progress: it fails, leaves nothing in its folder, which has
 * `entries` files, and works afterwards. */
template <class Filter>
void expectCanBeAborted(Filter* filter, const TemporaryFolder& folder, std::ptrdiff_t entries = 1)
{
  const vtkNew<vtkFaultyFilter> whole;
  for (WayToAbort& way : waysToAbort(filter, whole))
  {
    filter->Modified();
    const vtkNew<vtkCallbackCommand> abort;
    abort->SetClientData(&way);
    abort->SetCallback(
      [](vtkObject*, unsigned long, void* way, void*) { static_cast<WayToAbort*>(way)->abort(); });
    const unsigned long observer = filter->AddObserver(vtkCommand::ProgressEvent, abort);
    const Errors errors(filter);
    EXPECT_FALSE(updatePiece(filter, 0, 1));
    EXPECT_EQ(folder.entries(), entries);
    filter->RemoveObserver(observer);
    way.end();
    EXPECT_TRUE(updatePiece(filter, 0, 1));
    EXPECT_GT(vtkPointSet::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPoints(), 0);
  }
}

} // namespace smg::testing
