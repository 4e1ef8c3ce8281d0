// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Description/JsonNode.h"
#include "IO/Description/OptionValues.h"
#include "IO/Jobs/MeshJob.h"
#include "smg/Convert.h"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace smg
{

// Options in JSON. All functions throw Error with the place in it.

/** The keys of limitsIn(). */
inline constexpr std::initializer_list<const char*> LimitKeys{ "memory", "threads", "scratch",
  "scratch_limit" };
/** The limits of an object; those that it does not have are `defaults`. */
JobLimits limitsIn(const JsonNode& object, const JobLimits& defaults = {});

/** How a file is written. */
struct WritingOptions
{
  JobLimits limits;
  bool text = false; ///< see WriteMeshOptions
};
/** Of an object with no other keys. */
WritingOptions writingOptions(const char* options, const JobLimits& defaults);

/** How to open a mesh. `isFile`: of a file, not of arrays. `more`: keys of the caller. */
ConversionOptions conversionIn(
  const JsonNode& object, bool isFile, std::initializer_list<const char*> more = {});

/** A distance within which points are merged. */
double weldIn(const JsonNode& node);

/** Limits as the options that mean the same. */
void apply(const JobLimits& limits, ConversionOptions& options);
/** The limits with which a mesh was opened. */
JobLimits limitsOf(const ConversionOptions& options);

} // namespace smg
