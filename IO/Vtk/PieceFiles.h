// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Vtk/PieceInput.h"
#include "Solver/Core/Progress.h"

#include <filesystem>

namespace smg
{

/**
 * Writes the non-empty pieces of the input as NAME/NAME_p.vtp (or .vtu), followed by their index
 * NAME.pvtp (or .pvtu). The pieces must fulfil the contract that PieceStream checks. An existing
 * index and piece files of the same name are replaced. Throws Error and Cancelled; no new files are
 * left then.
 */
void writePieceFiles(
  PieceInput& input, int pieces, const std::filesystem::path& index, Progress& progress);

} // namespace smg
