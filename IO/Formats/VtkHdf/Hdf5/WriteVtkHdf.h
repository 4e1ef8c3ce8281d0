// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/VtkHdf/VtkHdfFormat.h"
#include "IO/Mesh/Format.h"

#include <cstdint>
#include <filesystem>

namespace smg
{

/**
 * Writes a .vsm file as VTKHDF, an unstructured grid of version 1.0: a partition for each range
 * of `cells` cells of the stream, with the points that these use, their stream indices as
 * GlobalIds, and points of earlier partitions marked as ghosts for programs that read the
 * partitions in parallel. Needs the memory of one partition.
 * @return a sentence for each difference between the file and the mesh
 * @throws Error if a file cannot be read or written; Cancelled. No file is left then.
 */
WriteNotes writeVtkHdf(const std::filesystem::path& vsm, const std::filesystem::path& path,
  const ProgressFunction& progress = {}, std::int64_t cells = VtkHdfPartitionCells);

} // namespace smg
