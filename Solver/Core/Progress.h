// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace smg
{

/** A part of an operation, for its progress. */
struct ProgressPart
{
  double begin = 0.0, end = 1.0;

  double at(double done) const { return this->begin + done * (this->end - this->begin); }
  ProgressPart of(double from, double to) const { return { this->at(from), this->at(to) }; }
  /** The function for the progress of the part alone, which calls that of the operation; empty if
   * that is. */
  ProgressFunction of(const ProgressFunction& whole) const
  {
    return whole ? [whole, *this](double done) { return whole(this->at(done)); }
                 : ProgressFunction();
  }
};

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
