// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Format.h"

#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

/**
 * Writes a mesh stream with known numbers of vertices and cells in the format of the suffix: .vsm,
 * .ply, .vtp, .vtu or .vtkhdf with all its columns, or .sma, .smb, .sva or .svb.
 * @return a note for each part of the mesh that the format cannot represent exactly
 * @throws Error like checkOutput() in MeshFile.h, if the stream is invalid, or if the file cannot
 * be written; Cancelled. No part of the file is left then.
 */
std::vector<std::string> writeMesh(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options = {});

/** The same for a .vsm file. */
std::vector<std::string> writeFromVsm(const std::filesystem::path& vsm,
  const std::filesystem::path& path, const ProgressFunction& progress = {});

} // namespace smg
