// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Description/JsonNode.h"
#include "IO/Jobs/Job.h"
#include "smg/Export.h"

#include <nlohmann/json_fwd.hpp>

#include <set>
#include <string>

namespace smg
{

struct JobOption;

/** Sets an option of a job to a value. Throws Error with the place if it cannot be that. */
SMG_EXPORT void readOption(const JsonNode& value, const JobOption& option, Job& job);

/** Sets the options of a job that an object has, by their keys. Throws Error with
 * the place for a key that the job does not have, and for options that are missing or wrong. */
SMG_EXPORT void readOptions(const JsonNode& object, Job& job);

/** The names of the columns of the mesh that the options of a job name. */
SMG_EXPORT std::set<std::string> columnsOf(const Job& job);

/** What the value of an option may be, in words, as "from 1 to 20"; empty: anything of its kind. */
SMG_EXPORT std::string allowedValues(const JobOption& option);

/**
 * The options of a job, which has been made anew, as an array of objects: `key`, `kind` ("number",
 * "count", "bytes", "flag", "choice", "column", "columns", "where", "size", "folder" or
 * "description"), `help`, and as far as they have them `required`, `advanced`, `common`,
 * `excludes`, `allowed`, `unit`, `choices` and `default`.
 */
SMG_EXPORT nlohmann::ordered_json describe(const Job& job);

} // namespace smg
