// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Estimate/Costs.h"
#include "smg/Convert.h"
#include "smg/Export.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace smg
{

/** A mesh file on which something is to be computed, before it is read. */
struct SMG_EXPORT EstimatedInput
{
  /** Estimates a mesh file from its header or its size, as estimateConversion(). */
  EstimatedInput(const std::filesystem::path& in, const ConversionOptions& options);

  StreamInfo info;                    ///< of the stream; its span may be estimated
  bool counted = false;               ///< the counts are from the header of the file
  std::int64_t streamBytes = 0;       ///< of the .vsm file
  std::int64_t conversionScratch = 0; ///< most bytes at once to convert the file; 0: it is a .vsm
  double conversionSeconds = 0;       ///< processor time
};

/** The values that a computation adds to a mesh. */
struct AddedValues
{
  int ofVertices = 0; ///< numbers a vertex
  int ofCells = 0;    ///< numbers a cell
};

/** An estimate of the costs of a command that computes something on a mesh, before it starts. */
struct SMG_EXPORT JobEstimate
{
  /** Of the computation `costs` on a mesh, written as `out`. `options` have the scratch folder. */
  JobEstimate(const EstimatedInput& in, const std::filesystem::path& out, const Costs& costs,
    const AddedValues& added, const ConversionOptions& options);

  std::int64_t vertices = 0, cells = 0;
  bool counted = false;           ///< the counts are from the header of the file
  std::int64_t memory_bytes = 0;  ///< accounted memory of the computation
  std::int64_t memory_limit = 0;  ///< of the computation
  std::int64_t scratch_bytes = 0; ///< most bytes of scratch files at once
  std::int64_t scratch_free = 0;  ///< free space in the folder for scratch files
  std::int64_t output_bytes = 0;  ///< of the result
  std::int64_t output_free = 0;   ///< free space in its folder
  int passes = 0;                 ///< over the mesh
  double cpu_seconds = 0;         ///< on a machine of 2023, with the conversion

  /** Rejects what certainly does not fit on the disks: throws Error, with both figures, unless
   * there is room for half of the scratch files, of which `written` bytes are there, and of the
   * result `out`, on one disk for both. */
  void checkRoom(const std::filesystem::path& out, const std::filesystem::path& scratchFolder,
    std::int64_t written = 0) const;

  /** As a JSON object with the names above. */
  std::string json(int indent = 2) const;
};

} // namespace smg
