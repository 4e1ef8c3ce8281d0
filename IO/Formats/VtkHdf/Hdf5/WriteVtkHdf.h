// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Format.h"

#include <cstdint>
#include <filesystem>

namespace smg
{

/** Cells of a partition, unless another number is given. */
inline constexpr std::int64_t VtkHdfPartitionCells = std::int64_t(1) << 18;

/**
 * Writes a .vsm file as VTKHDF, an unstructured grid of version 1.0: a partition for each stretch
 * of `cells` cells of the stream, with the points that these use, their numbers in the stream as
 * GlobalIds, and those that an earlier partition has as ghosts, so that programs which read the
 * partitions in parallel know them. In the memory of one partition.
 * @return a sentence for each thing that the file does not hold as the mesh has it
 * @throws Error if a file cannot be read or written; Cancelled. Nothing is left of the file then.
 */
WriteNotes writeVtkHdf(const std::filesystem::path& vsm, const std::filesystem::path& path,
  const ProgressFunction& progress = {}, std::int64_t cells = VtkHdfPartitionCells);

} // namespace smg
