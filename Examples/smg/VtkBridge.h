// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

/**
 * Makes readable what only VTK reads of the VTK formats, if `path` has one of them: the library
 * with the VTK readers, which lies beside this program's other libraries, is loaded when such a
 * file needs it, since VTK takes hundreds of megabytes of address space.
 */
void loadVtkFor(const std::filesystem::path& path);
