// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/IO/vtkPieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPointSet.h"

namespace smg::testing
{

/** Aborts a filter at its first progress: it fails, leaves nothing in its folder, which has
 * `entries` files, and works afterwards. */
template <class Filter>
void expectCanBeAborted(Filter* filter, const TemporaryFolder& folder, std::ptrdiff_t entries = 1)
{
  const vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1); });
  const unsigned long observer = filter->AddObserver(vtkCommand::ProgressEvent, abort);
  const Errors errors(filter);
  EXPECT_FALSE(updatePiece(filter, 0, 1));
  EXPECT_EQ(folder.entries(), entries);
  filter->RemoveObserver(observer);
  filter->SetAbortExecute(0);
  EXPECT_TRUE(updatePiece(filter, 0, 1));
  EXPECT_GT(vtkPointSet::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPoints(), 0);
}

} // namespace smg::testing
