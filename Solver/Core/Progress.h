// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Error.h"

#include <algorithm>
#include <functional>

namespace smg
{

/**
 * A progress callback: called with the fraction done (0 to 1, never decreasing over a whole
 * operation); answers whether to go on. False ends the operation with `Cancelled`.
 */
using ProgressFunction = std::function<bool(double)>;

/** Keeps the fractions monotone and turns a refusal into `Cancelled`. */
class Progress
{
public:
  explicit Progress(ProgressFunction function = {})
    : Function(std::move(function))
  {
  }

  /** Reports that `fraction` (0 to 1) of the operation is done. Throws Cancelled. */
  void update(double fraction)
  {
    this->Done = std::max(this->Done, std::min(fraction, 1.0));
    if (this->Function && !this->Function(this->Done))
    {
      throw Cancelled();
    }
  }

private:
  ProgressFunction Function;
  double Done = 0.0;
};

} // namespace smg
