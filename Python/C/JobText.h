// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Jobs/MeshJob.h"
#include "IO/Jobs/SimplifyJob.h"

#include <memory>
#include <string>

namespace smg
{

/** The job of this kind of a description in JSON, checked as far as that is possible without the
 * mesh. Limits that it does not have are `defaults`.
 * Throws ArgumentError with the place in the description. */
std::unique_ptr<MeshJob> jobOf(
  const std::string& kind, const char* description, const JobLimits& defaults);

/** The same for the job "simplify", whose result is another mesh. */
SimplifyJob simplifyJobOf(const char* description, const JobLimits& defaults);

} // namespace smg
