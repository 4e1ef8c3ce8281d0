// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Text.h"
#include "smg/Convert.h"
#include "smg/Export.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace smg
{

/**
 * The mesh that a conversion makes of a file, as far as the format, the header, or else the first
 * cell tells (lookAtMesh()): the type of the cells, and some or all of the columns. None of a .vsm
 * file or a compressed mesh stream.
 * @param options of the conversion: the part and the cells; memory, scratch and progress
 * @throws Error if the file is not valid up to there; Cancelled
 */
SMG_EXPORT std::optional<StreamInfo> statedMesh(
  const std::filesystem::path& path, const ConversionOptions& options = {});

/** An estimate of the cost of a conversion, before the mesh is read. */
struct SMG_EXPORT ConversionEstimate
{
  std::int64_t vertices = 0, cells = 0;
  /** The stream, whose width and span are estimated. Without a header its cells are as of the
   * suffix. */
  StreamInfo mesh;
  /** Whether the counts are from the header of the file; otherwise they are estimated from its
   * size. */
  bool counted = false;
  std::int64_t memory_bytes = 0;  ///< limit of the accounted memory
  std::int64_t scratch_bytes = 0; ///< maximum bytes of scratch files at once
  std::int64_t scratch_free = 0;  ///< free space in the folder for scratch files
  std::int64_t output_bytes = 0;  ///< of a .vsm file
  double cpu_seconds = 0;         ///< on a machine of 2023
};

/** Estimates the conversion of a mesh file from its header or its size. `throughVsm`: the .vsm file
 * is a scratch file, too. Throws Error if the file cannot be opened or its format is unknown. */
SMG_EXPORT ConversionEstimate estimateConversion(
  const std::filesystem::path& in, const ConversionOptions& options = {}, bool throughVsm = false);

/** Estimates the conversion of a mesh with these counts and columns to a .vsm file that is a
 * scratch file, too. */
ConversionEstimate estimateConversion(const StreamInfo& mesh, const ConversionOptions& options);

/** The memory limit of a conversion, bytes. */
inline std::int64_t memoryOf(const ConversionOptions& options)
{
  return options.memoryLimit > 0 ? options.memoryLimit : ConversionOptions::DefaultMemory;
}
/** The folder for scratch files that an option names; empty: the temporary folder. */
std::filesystem::path scratchPlace(const std::filesystem::path& folder);

/** The free bytes of the file system of `folder`; empty: the temporary folder. -1: not known. */
std::int64_t freeBytes(const std::filesystem::path& folder);

/** "12 MiB are free", of freeBytes(); negative: there is no such folder to ask. */
inline std::string freeSpace(std::int64_t bytes)
{
  return bytes < 0 ? "the folder does not exist" : mebibytes(bytes) + " are free";
}
/** The most bytes of scratch files at once while a parsed mesh is ordered and written, the latter
 * to a scratch file of `written` bytes. */
std::int64_t scratchBytes(
  const StreamInfo& mesh, const ConversionOptions& options, std::int64_t written = 0);

/** The bytes that certainly are needed where so many are estimated. The estimates of meshes that
 * tell their counts are at most 1.5 times the truth. */
constexpr std::int64_t certainBytes(std::int64_t estimated)
{
  return estimated / 3 * 2;
}

/**
 * Rejects scratch files that certainly do not fit: throws Error, with both figures, unless `folder`
 * (empty: the temporary folder) has space for the certain part of `bytes`, an estimate, minus those
 * already `written`.
 */
void checkScratchRoom(
  const std::filesystem::path& folder, std::int64_t bytes, std::int64_t written = 0);

} // namespace smg
