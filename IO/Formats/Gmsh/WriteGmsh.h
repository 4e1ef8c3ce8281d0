// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/MeshFileWriter.h"

#include <filesystem>
#include <memory>

namespace smg
{

/** Begins a file of version 2.2, text; see MeshFileFunction. */
std::unique_ptr<MeshFileWriter> makeGmshWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* workspace);

} // namespace smg
