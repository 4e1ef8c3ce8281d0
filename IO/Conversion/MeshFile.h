// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Stream/MeshSource.h"

#include <filesystem>
#include <string>

namespace smg
{

/** What kind of file a mesh comes from or goes to. */
enum class MeshFileKind
{
  Vsm,     ///< the container of this library
  Stream,  ///< SMA, SMB, SVA, SVB
  Indexed, ///< everything that importMesh() reads
  VtkXml,  ///< .vtp and .vtu, as output
  Ply,     ///< as output
  Unknown  ///< none of these
};

/**
 * The kind of an input file, by content where that says it, else by suffix: Vsm, Stream, Indexed,
 * or Unknown if neither says anything. The file may be damaged all the same, or not exist.
 */
MeshFileKind kindOfInput(const std::filesystem::path& path);

/** The kind of an output file, by suffix: Vsm, Stream, VtkXml, Ply or Unknown. */
MeshFileKind kindOfOutput(const std::filesystem::path& path);

/**
 * Refuses an output file before the work: throws Error if its suffix is that of no kind, its format
 * does not hold these cells, it is a folder, or its folder does not exist or cannot be written to.
 */
void checkOutput(const std::filesystem::path& path, CellType cellType);

/** The same as far as it can be known before the mesh is. */
void checkOutput(const std::filesystem::path& path);

/** Throws Error if a file cannot be made there whatever its format: the path is a folder, a device
 * or a pipe, or its folder does not exist or cannot be written to. */
void checkOutputPlace(const std::filesystem::path& path);

/**
 * Throws Error if the output is an input, by whatever name or link. `what`: what the input is, as
 * "the mesh itself".
 */
void checkIsNotInput(const std::filesystem::path& in, const std::filesystem::path& out,
  const std::string& what = "the mesh itself");

} // namespace smg
