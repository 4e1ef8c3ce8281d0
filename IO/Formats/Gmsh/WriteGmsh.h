// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/MeshFileWriter.h"
#include "IO/Mesh/Format.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace smg
{

/** Begins a file of version 2.2, text; see MeshFileFunction. */
std::unique_ptr<MeshFileWriter> makeGmshWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* workspace);

/** About the bytes of such a file, and of the scratch files of its writer. */
std::int64_t bytesOfGmsh(const MeshToWrite& written);
std::int64_t scratchOfGmsh(const StreamInfo& mesh, std::int64_t memory, bool text);

} // namespace smg
