// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/IndexedMesh.h"
#include "IO/Import/MemoryBudget.h"
#include "Solver/Core/Progress.h"

#include <filesystem>

namespace smg
{

/** What kind of file a mesh comes from or goes to. */
enum class MeshFileKind
{
  Vsm,     ///< the container of this library
  Stream,  ///< SMA, SMB, SVA, SVB
  Indexed, ///< everything that importMesh() reads
  VtkXml,  ///< .vtp and .vtu, as output
  Unknown  ///< none of these
};

/**
 * The kind of an input file, by content where that says it, else by suffix: Vsm, Stream, Indexed,
 * or Unknown if neither says anything. The file may be damaged all the same, or not exist.
 */
MeshFileKind kindOfInput(const std::filesystem::path& path);

/** The kind of an output file, by suffix: Vsm, Stream, VtkXml or Unknown. */
MeshFileKind kindOfOutput(const std::filesystem::path& path);

/**
 * Reads a whole .vsm file into memory. Vertices and cells are numbered as in the stream.
 * @throws Error when converting the mesh would exceed the budget
 */
IndexedMesh loadVsm(const std::filesystem::path& path, const MemoryBudget& budget,
  const ProgressFunction& progress = {});

} // namespace smg
