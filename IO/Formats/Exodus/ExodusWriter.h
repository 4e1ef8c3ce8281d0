// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/MeshFileWriter.h"
#include "IO/Mesh/Format.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace smg
{

/** Begins a file; see MeshFileFunction. */
std::unique_ptr<MeshFileWriter> makeExodusWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* workspace);

/** About the bytes of such a file. */
std::int64_t bytesOfExodus(const MeshToWrite& written);

} // namespace smg
