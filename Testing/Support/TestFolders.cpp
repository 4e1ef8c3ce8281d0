// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/TestFolders.h"

namespace smg::testing
{
std::filesystem::path sourceFolder()
{
  return SMG_SOURCE_DIR;
}

std::filesystem::path archiveFolder()
{
  return SMG_TEST_DATA_DIR;
}
} // namespace smg::testing
