// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/VsmWriter.h"
#include "Solver/Core/Progress.h"
#include "Solver/Storage/BlockFile.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

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

/**
 * Writes a mesh stream with a known number of cells to a .vsm file.
 * @param origin see VsmWriter::finish()
 * @param add adds data that the stream does not deliver, before the file is finished; may be empty
 * @param workers threads that compress blocks, see BlockFileWriter
 * @param apart a further thread appends a block while the next one is read, if `workers` are
 * several: only for a source that does not use them
 * @throws Error if the stream is not valid or the file cannot be written; Cancelled. Nothing is
 * left of the file then.
 */
WrittenVsm writeVsm(MeshSource& source, const std::filesystem::path& path,
  Codec codec = Codec::Zstd, const ProgressFunction& progress = {}, const std::string& origin = {},
  const std::function<void(VsmWriter&)>& add = {}, Workers* workers = nullptr, bool apart = false);

/**
 * Copies the isolated vertices of a .vsm file, with the columns that both have, to the writer of a
 * stream like `info`, since a stream made from a .vsm file does not contain them. Columns with a
 * value ColumnSpec::isolated get that.
 */
SMG_EXPORT void copyIsolated(
  const std::filesystem::path& from, const StreamInfo& info, VsmWriter& writer);

} // namespace smg
