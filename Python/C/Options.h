// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Description/JsonNode.h"
#include "IO/Jobs/MeshJob.h"
#include "smg/Convert.h"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace smg
{

// Options in JSON. All functions throw Error with the place in it.

/** The bytes of a number of at least 1 MiB, or of a text with a unit. */
std::int64_t bytesIn(const JsonNode& node);
/** The place of a text among some. */
std::size_t choiceIn(const JsonNode& node, std::initializer_list<const char*> choices);
/** true or false. */
bool flagIn(const JsonNode& node);
/** A relative residual at which to stop. */
double toleranceIn(const JsonNode& node);
/** A number of V-cycles or passes, at least 1. */
int countIn(const JsonNode& node);

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
