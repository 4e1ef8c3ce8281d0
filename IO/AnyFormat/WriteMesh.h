// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Format.h"

#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

/**
 * Writes a mesh stream, which says its numbers of vertices and cells, in the format of the suffix:
 * .vsm, .ply, .vtp, .vtu or .vtkhdf with all its columns, or .sma, .smb, .sva or .svb.
 * @return a sentence for each thing that the format does not hold as the mesh has it
 * @throws Error as checkOutput() in MeshFile.h, if the stream is not valid, or the file cannot be
 * written; Cancelled. Nothing is left of the file then.
 */
std::vector<std::string> writeMesh(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options = {});

/** The same of a .vsm file. */
std::vector<std::string> writeFromVsm(const std::filesystem::path& vsm,
  const std::filesystem::path& path, const ProgressFunction& progress = {});

} // namespace smg
