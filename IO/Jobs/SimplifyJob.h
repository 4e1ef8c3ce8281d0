// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Jobs/Job.h"
#include "smg/Simplify.h"

#include <span>

namespace smg
{

/** Simplifies a surface: a job whose result is another mesh. */
class SMG_EXPORT SimplifyJob : public Job
{
public:
  SimplifyJob() { this->name = "simplify"; }

  SimplifyTarget target;
  SimplifyOptions options;

  std::span<const JobOption> table() const override;
  void setLimits(const JobLimits& limits) override;
  void check() const override;
};

} // namespace smg
