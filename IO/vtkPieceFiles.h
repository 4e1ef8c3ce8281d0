// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/vtkPieceInput.h"
#include "Solver/Core/Progress.h"

#include <filesystem>

namespace smg
{

/**
 * Writes the pieces of the input that are not empty as NAME/NAME_p.vtp (or .vtu) and their index
 * NAME.pvtp (or .pvtu), which comes last. The pieces must keep the contract that PieceStream
 * checks. An index and piece files of the same name are replaced. Throws Error and Cancelled; then
 * nothing new is left.
 */
void writePieceFiles(
  PieceInput& input, int pieces, const std::filesystem::path& index, Progress& progress);

} // namespace smg
