// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"
#include "IO/Formats/Vsm/VsmWriter.h"
#include "IO/Mesh/Format.h"
#include "Solver/Core/Progress.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/WriteMesh.h"

#include <filesystem>
#include <functional>
#include <string>

namespace smg
{

struct WrittenVsm
{
  StreamInfo info;
  double meanWidth = 0; ///< mean over the cells of the number of vertices alive
};

/** How to write a mesh stream. */
struct WriteVsmOptions
{
  Codec codec = Codec::Zstd;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch = {};
  /** See VsmWriter::finish(). */
  std::string origin = {};
  /** Adds data that the stream does not deliver, before the file is finished; may be empty. */
  std::function<void(VsmWriter&)> add = {};
  /** Threads that compress blocks, see BlockFileWriter. */
  Workers* workers = nullptr;
  /** A further thread appends a block while the next one is read, if `workers` are several: only
   * for a source that does not use them. */
  bool apart = false;
  ProgressFunction progress = {};
};

/**
 * Writes a mesh stream with a known number of cells to a .vsm file.
 * @throws Error if the stream is not valid or the file cannot be written; Cancelled. Nothing is
 * left of the file then.
 */
WrittenVsm writeVsm(
  MeshSource& source, const std::filesystem::path& path, const WriteVsmOptions& options = {});

/** Calls use(number of the first, vertices) for the vertices of no cell of a .vsm file, some at a
 * time. `fingerprint`: unless empty, that which the file must have. */
SMG_EXPORT void forEachIsolated(
  const std::filesystem::path& vsm, const std::string& fingerprint, const CompleteIsolated& use);

/**
 * Copies the isolated vertices of a .vsm file, with the columns that both have, to the writer of a
 * stream like `info`, since a stream made from a .vsm file does not contain them. Columns with a
 * value ColumnSpec::isolated get that. `complete` adds columns to those of the file. `fingerprint`:
 * unless empty, that which the file must have. `change` is called with the vertices as written.
 */
SMG_EXPORT void copyIsolated(const std::filesystem::path& from, const StreamInfo& info,
  VsmWriter& writer, const CompleteIsolated& complete = {}, const std::string& fingerprint = {},
  const CompleteIsolated& change = {});

} // namespace smg
