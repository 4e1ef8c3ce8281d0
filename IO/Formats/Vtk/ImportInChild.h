// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vtk/RecodedImport.h"
#include "IO/Formats/Vtk/VtkImporter.h"

#include <filesystem>

namespace smg
{

/**
 * As importRecoded(), where the files are recoded in processes of their own, whose memory and CPU
 * time are limited: VTK's readers trust a file, so a damaged one can make them crash, hang or ask
 * for any amount of memory. Only for programs that have no other thread at that time, as a
 * command-line program has.
 * @throws Error as the recoder, or if it crashed or exceeded its limits; Cancelled
 */
void importInChild(const VtkRecoder& recode, const std::filesystem::path& path, VtkXmlKind kind,
  RawMeshBuilder& builder, const ProgressFunction& progress);

} // namespace smg
