// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/FileDescriptor.h"

#include <gtest/gtest.h>

int main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  // Thousands of small results would otherwise wait for the disk, most of the time of the tests.
  smg::FileDescriptor::setDurable(false);
  return RUN_ALL_TESTS();
}
