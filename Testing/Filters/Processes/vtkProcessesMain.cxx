// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/FileDescriptor.h"

#include "vtkMPIController.h"
#include "vtkNew.h"

#include <gtest/gtest.h>
#include <unistd.h>

int main(int argc, char** argv)
{
  // Processes that wait for one another never end.
  constexpr unsigned Seconds = 8400;
  ::alarm(Seconds);
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(controller);
  ::testing::InitGoogleTest(&argc, argv);
  smg::FileDescriptor::setDurable(false);
  if (controller->GetLocalProcessId() != 0)
  {
    GTEST_FLAG_SET(brief, true); // failures alone
  }
  const int failed = RUN_ALL_TESTS();
  vtkMultiProcessController::SetGlobalController(nullptr);
  controller->Finalize();
  return failed;
}
