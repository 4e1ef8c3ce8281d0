// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vtk/VtkImporter.h"

#include <filesystem>
#include <functional>

namespace smg
{

/**
 * Reads a .vtp or .vtu file of any compression and writes it to the second path, as a file that is
 * parsed as a stream: appended raw data without compression. Throws Error.
 */
using VtkRecoder =
  std::function<void(const std::filesystem::path& from, const std::filesystem::path& to)>;

/**
 * Imports a file in a format of VTK's XML, parallel or not, after its pieces were recoded to
 * scratch files. For a VtkImporter.
 */
void importRecoded(const VtkRecoder& recode, const std::filesystem::path& path, VtkXmlKind kind,
  RawMeshBuilder& builder, const ProgressFunction& progress);

} // namespace smg
