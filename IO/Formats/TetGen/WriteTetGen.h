// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/MeshFileWriter.h"
#include "IO/Mesh/Format.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace smg
{

/** Suffixes of the files of faces and edges, which a mesh may have. */
inline constexpr const char *TetGenFaces = ".face", *TetGenEdges = ".edge";

/** The name of a file before compression. */
std::filesystem::path plainTetGenName(std::filesystem::path name);
/** Whether it is the file of the elements. */
bool isOfTetGenElements(const std::filesystem::path& name);

/** The files of a mesh that is written, besides the one that is named; those of sides only if it
 * has groups of facets. */
std::vector<std::filesystem::path> furtherTetGenOutputs(const std::filesystem::path& path);

/** Begins both files; see MeshFileFunction. */
std::unique_ptr<MeshFileWriter> makeTetGenWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* workspace);

/** About the bytes of both files. */
std::int64_t bytesOfTetGen(const MeshToWrite& written);

} // namespace smg
