// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Format.h"
#include "smg/Export.h"

#include <filesystem>
#include <string>

namespace smg
{

/**
 * The kind of an input file, by content where that says it, else by suffix: Vsm, Stream, Indexed,
 * or Unknown if neither says anything. The file may be damaged all the same, or not exist.
 */
SMG_EXPORT MeshFileKind kindOfInput(const std::filesystem::path& path);

/** The kind of an output file, by suffix; Unknown if meshes are not written so. */
SMG_EXPORT MeshFileKind kindOfOutput(const std::filesystem::path& path);

/**
 * Refuses an output file before the work: throws Error if meshes are not written with its suffix,
 * its format does not hold these cells, it is a folder, or its folder does not exist or cannot be
 * written to.
 */
SMG_EXPORT void checkOutput(const std::filesystem::path& path, CellType cellType);

/** The same as far as it can be known before the mesh is. */
SMG_EXPORT void checkOutput(const std::filesystem::path& path);

/** Throws Error if a file cannot be made there whatever its format: the path is a folder, a device
 * or a pipe, or its folder does not exist or cannot be written to. */
void checkOutputPlace(const std::filesystem::path& path);

/**
 * Throws Error if the output is an input, by whatever name or link. `what`: what the input is, as
 * "the mesh itself".
 */
SMG_EXPORT void checkIsNotInput(const std::filesystem::path& in, const std::filesystem::path& out,
  const std::string& what = "the mesh itself");

} // namespace smg
