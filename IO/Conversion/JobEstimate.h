// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/VsmBytes.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "smg/Convert.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

struct ConversionEstimate;

/** A mesh on which something is to be computed, before it is read. */
struct SMG_EXPORT EstimatedInput
{
  /** Estimates a mesh in memory, which is to be sorted, from its counts and columns. */
  EstimatedInput(const StreamInfo& mesh, const ConversionOptions& options);
  /** Estimates a mesh file from its header or its size, as estimateConversion(). */
  EstimatedInput(const std::filesystem::path& in, const ConversionOptions& options);

  StreamInfo info;                    ///< of the stream; its width and span may be estimated
  bool counted = false;               ///< the counts are from the header of the file
  std::int64_t streamBytes = 0;       ///< of the .vsm file
  VsmParts parts;                     ///< of the .vsm file; none: it is to be made
  bool converts = false;              ///< the file is no .vsm, which is a scratch file then
  std::int64_t conversionScratch = 0; ///< most bytes at once to convert the file, with that file
  double conversionSeconds = 0;       ///< processor time

private:
  explicit EstimatedInput(const ConversionEstimate& conversion);
};

/** The values that a computation adds to a mesh, or replaces. */
struct AddedValues
{
  std::vector<ColumnSpec> ofVertices, ofCells;
  bool movesVertices = false;
};

/** Those of SolvedMesh. */
SMG_EXPORT AddedValues solvedValues(const ProblemDescription& problem);

/** The order of a written mesh. */
enum class WrittenOrder
{
  Stream,
  Restored, ///< that of the original file, by the original numbers in a temporary .vsm file
  Rewritten ///< the file IN again with other positions
};

/** The result of a computation, as a file. */
struct EstimatedResult
{
  std::filesystem::path out; ///< empty: it is not written
  AddedValues added;
  WrittenOrder order = WrittenOrder::Stream;
  std::int64_t memory = 0; ///< bytes for the sorts of the orders of a file
  bool text = false;       ///< see WriteMeshOptions
};

/** An estimate of the costs of a command that computes something on a mesh, before it starts. */
struct SMG_EXPORT JobEstimate
{
  /** Of the computation `costs` on a mesh. `options` have the scratch folder. */
  JobEstimate(const EstimatedInput& in, const EstimatedResult& result, const Costs& costs,
    const ConversionOptions& options);
  /** Of convert(). */
  JobEstimate(const std::filesystem::path& in, const std::filesystem::path& out,
    const ConversionOptions& options);

  std::int64_t vertices = 0, cells = 0;
  bool counted = false;           ///< the counts are from the header of the file
  std::int64_t memory_bytes = 0;  ///< accounted memory of the computation
  std::int64_t memory_limit = 0;  ///< of the computation
  std::int64_t scratch_bytes = 0; ///< most bytes of scratch files at once
  std::int64_t scratch_free = 0;  ///< free space in the folder for scratch files
  std::int64_t output_bytes = 0;  ///< of the result
  std::int64_t output_free = 0;   ///< free space in its folder
  int passes = 0;                 ///< over the mesh; 0: it is converted
  double cpu_seconds = 0;         ///< on a machine of 2023, with the conversion

  /** Rejects what certainly does not fit on the disks: throws Error, with both figures, unless
   * there is room for what certainly is needed of the scratch files, of which `written` bytes are
   * there, and of the result `out`, on one disk for both. */
  void checkRoom(const std::filesystem::path& out, const std::filesystem::path& scratchFolder,
    std::int64_t written = 0) const;

  /** As a JSON object with the names above. */
  std::string json(int indent = 2) const;
};

} // namespace smg
