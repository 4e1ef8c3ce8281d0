// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace smg::testing
{
/// The top of the source tree.
std::filesystem::path sourceFolder();

/// The unpacked archive of test meshes (SMG_TEST_DATA_DIR); empty if there is none.
std::filesystem::path archiveFolder();
} // namespace smg::testing
