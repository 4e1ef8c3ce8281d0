// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

/**
 * Makes the VTK formats readable if `path` has one of them: loads the library with the VTK readers,
 * which lies beside this program's other libraries. Done on demand, since VTK takes hundreds of
 * megabytes of address space and a solve on a .vsm file needs none of it.
 */
void loadVtkFor(const std::filesystem::path& path);
