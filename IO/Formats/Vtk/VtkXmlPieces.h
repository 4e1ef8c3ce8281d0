// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"

#include <filesystem>
#include <vector>

namespace smg
{

/** The files that a .pvtp or .pvtu file names. Throws Error if it is none. */
std::vector<std::filesystem::path> vtkXmlPieceFiles(InputFile& file);

} // namespace smg
