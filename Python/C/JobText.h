// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Jobs/MeshJob.h"
#include "smg/Simplify.h"

#include <memory>
#include <string>

namespace smg
{

/** The job "solve", "deform", "smooth", "blend" or "distance" of a description in JSON, checked as
 * far as that is possible without the mesh. Limits that it does not have are `defaults`. Throws
 * ArgumentError with the place in the description. */
std::unique_ptr<MeshJob> jobOf(
  const std::string& kind, const char* description, const JobLimits& defaults);

/** What simplify() is to do. */
struct SimplifyCall
{
  SimplifyTarget target;
  SimplifyOptions options;
};

/** The same for the simplification of a mesh, which is no MeshJob. */
SimplifyCall simplifyCallOf(const char* description, const JobLimits& defaults);

} // namespace smg
