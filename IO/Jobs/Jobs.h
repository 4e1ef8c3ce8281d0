// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Jobs/Job.h"
#include "smg/Export.h"

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <span>
#include <string_view>

namespace smg
{

class MeshJob;

/** A kind of job. */
struct JobKind
{
  const char* name; ///< of its command, and of its functions
  const char* help; ///< a sentence without its end
  const char* verb; ///< as "solving"
  const char* deed; ///< before the name of the mesh, as "Solution on"
  const char* done; ///< of the mesh, as "solved on"
  std::unique_ptr<Job> (*make)();
};

/** All kinds of jobs. */
SMG_EXPORT std::span<const JobKind> jobKinds();

/** The kind of this name. Throws Error, which lists those that there are. */
SMG_EXPORT const JobKind& jobKind(std::string_view name);
/** A new job of a kind. Throws Error, which lists those that there are. */
SMG_EXPORT std::unique_ptr<Job> makeJob(std::string_view kind);

/** The same of a job on a mesh that gives it further values. */
SMG_EXPORT std::unique_ptr<MeshJob> makeMeshJob(std::string_view kind);

/** What describe() says of each of the `jobs`, and what describeFields() does of the entries of a
 * `report`, of a `simplify_report` and of an `estimate`. */
SMG_EXPORT nlohmann::ordered_json describeAll();

} // namespace smg
