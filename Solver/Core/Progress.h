// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"

#include <algorithm>
#include <functional>

namespace smg
{

/** Keeps the fractions monotone and throws `Cancelled` if the callback returns false. */
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

  double done() const { return this->Done; }
  /** The same as before. Throws Cancelled. */
  void poll() { this->update(this->Done); }

private:
  ProgressFunction Function;
  double Done = 0.0;
};

} // namespace smg
