// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/ConversionReport.h"
#include "IO/Order/StreamOrder.h"
#include "Solver/Core/Progress.h"
#include "Solver/Storage/BlockFile.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace smg
{

/** How to convert. */
struct ConversionOptions
{
  StreamOrder order = StreamOrder::BreadthFirst;
  /** Promise on the memory, bytes; 0: half of the machine's memory. */
  std::int64_t memoryLimit = 0;
  /** How a .vsm file is compressed. */
  Codec codec = Codec::Zstd;
  /** What a .vsm file says of where it comes from, in UTF-8; empty: nothing. */
  std::string origin;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  ProgressFunction progress;
};

/**
 * Brings a mesh into a stream order and writes it.
 *
 * In: everything that importMesh() reads, .vsm, and the streaming formats SMA, SMB, SVA and SVB.
 * Out, by the suffix: .vsm; .sma, .smb (triangles), .sva, .svb (tetrahedra); .ply, .vtp
 * (triangles), .vtu.
 *
 * A file that is a mesh stream already is converted in little memory if its order is kept.
 * Everything else is held in memory. The stream is compact; vertices of no cell are left out;
 * degenerate and duplicate cells stay, with their flags in the cell column `CellFlags`. The columns
 * `OriginalId` and `OriginalCellId` keep the places in the file, from 0; if it has such columns of
 * int64 already, those are kept instead, and columns of another type that have these names get
 * others (`OriginalId_1`), with a note.
 *
 * @throws Error when the input is not valid (see importMesh), the output cannot be written, the
 * formats do not go together, or the memory limit is below the need (before the mesh is read, with
 * both figures); Cancelled. No output and no scratch file is left behind then.
 */
ConversionReport convert(const std::filesystem::path& in, const std::filesystem::path& out,
  const ConversionOptions& options = {});

} // namespace smg
