// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/FileDescriptor.h"

#include <gtest/gtest.h>
#include <mpi.h>
#include <unistd.h>

int main(int argc, char** argv)
{
  // The watchdog of the failures: processes that wait for one another never end.
  constexpr unsigned Seconds = 8400;
  ::alarm(Seconds);
  MPI_Init(&argc, &argv);
  ::testing::InitGoogleTest(&argc, argv);
  smg::FileDescriptor::setDurable(false);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0)
  {
    GTEST_FLAG_SET(brief, true); // failures alone
  }
  const int failed = RUN_ALL_TESTS();
  MPI_Finalize();
  return failed;
}
