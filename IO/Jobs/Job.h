// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace smg
{

struct JobOption;

/** What any computation may take. */
struct JobLimits
{
  std::int64_t memory = 0;       ///< bytes of accounted memory; 0: the default of the job
  int threads = 0;               ///< that compute; 0: one per core
  std::filesystem::path scratch; ///< folder for scratch files; empty: the temporary one
  std::int64_t scratchLimit = 0; ///< bytes of scratch files at once; 0: any number
};

/** Something to do with a mesh, and all that it is asked. */
class SMG_EXPORT Job
{
public:
  virtual ~Job() = default;

  /** What error messages call the text that says what to do. */
  std::string name;
  /** What its description says of limits, for setLimits(). */
  JobLimits limits;

  /** What it may be asked (Jobs/JobOption.h), in the order in which that is read. */
  virtual std::span<const JobOption> table() const = 0;
  virtual void setLimits(const JobLimits& limits) = 0;
  /** Throws Error if what is to be done cannot be right, whatever the mesh. */
  virtual void check() const = 0;
};

} // namespace smg
