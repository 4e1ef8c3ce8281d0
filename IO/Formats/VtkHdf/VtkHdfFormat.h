// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"
#include "smg/Export.h"

#include <cstdint>

namespace smg
{

/** The default number of cells of a partition of a written file. */
inline constexpr std::int64_t VtkHdfPartitionCells = std::int64_t(1) << 18;

/** The code that needs the HDF5 library, which is slow to load, with thirty others: a separate
 * library (the folder Hdf5), which is loaded when a file of the format is read or written. */
struct VtkHdfLibrary
{
  void (*import)(InputFile& file, RawMeshBuilder& builder, const MeshPart& part);
  std::optional<FileCounts> (*counts)(InputFile& file, const MeshPart& part);
  WriteNotes (*write)(const std::filesystem::path& vsm, const std::filesystem::path& path,
    const ProgressFunction& progress);
  std::vector<double> (*times)(const std::filesystem::path& path);
};

} // namespace smg

/** The only symbol of the library that is looked up. */
extern "C" SMG_EXPORT const smg::VtkHdfLibrary* smgVtkHdfLibrary();
