// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/ConversionReport.h"
#include "IO/Order/StreamOrder.h"
#include "IO/Raw/RawMeshBuilder.h"
#include "Solver/Core/Progress.h"
#include "Solver/Storage/BlockFile.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace smg
{

/** How to convert. */
struct ConversionOptions
{
  StreamOrder order = StreamOrder::BreadthFirst;
  /** Memory limit that holds unless another one is given, bytes. */
  static constexpr std::int64_t DefaultMemory = std::int64_t(256) << 20;

  /** Promise on the memory of the mesh and its order, bytes; 0: DefaultMemory. */
  std::int64_t memoryLimit = 0;
  /** Which cells to keep of a file that has surface cells and volume cells. */
  CellChoice cells = CellChoice::Only;
  /** Merges points within this distance of each other; 0: equal coordinates; none: no points. */
  std::optional<double> weld;
  /** Of a file with time steps (VTKHDF): which one, from 0. */
  std::int64_t timeStep = 0;
  /** Of a file with partitions (VTKHDF): which one, from 0; none: all, joined. */
  std::optional<std::int64_t> partition;
  /** Writes vertices and cells in the order that they had in the first file: see writeRestored().
   */
  bool restoreOrder = false;
  /** How a .vsm file is compressed. */
  Codec codec = Codec::Zstd;
  /** What a .vsm file says of where it comes from, in UTF-8; empty: nothing. */
  std::string origin;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  ProgressFunction progress;
};

/**
 * Brings a mesh into a stream order and writes it, in a fixed amount of memory whatever its size.
 *
 * In: everything that importMesh() reads, .vsm, and the streaming formats SMA, SMB, SVA and SVB, or
 * one of them compressed by gzip; at most 4,294,967,294 vertices and as many cells.
 * Out, by the suffix: .vsm; .sma, .smb (triangles), .sva, .svb (tetrahedra); .ply, .vtp
 * (triangles), .vtu; with `restoreOrder` the formats of writeRestored().
 *
 * The stream is compact; vertices of no cell are left out of it, a .vsm file has them beside it;
 * degenerate and duplicate cells stay, with their flags in the cell column `CellFlags`. The columns
 * `OriginalId` and `OriginalCellId` keep the places in the file, from 0; if it has such columns of
 * int64 already, those are kept instead, and columns of another type that have these names get
 * others (`OriginalId_1`), with a note.
 *
 * @throws Error when the input is not valid (see importMesh), the output cannot be written, the
 * formats do not go together, the memory limit is below Workspace::LeastMemory, or the disk has too
 * little room for the scratch files (told before they are written); Cancelled. No output and no
 * scratch file is left behind then.
 */
ConversionReport convert(const std::filesystem::path& in, const std::filesystem::path& out,
  const ConversionOptions& options = {});

} // namespace smg
