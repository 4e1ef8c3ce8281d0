// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace smg
{

/** The largest weight of a row, 0 if there is none, and whether the row is stiff (see StiffRows),
 * in four bytes, since every row of a window has them. */
class StrongestWeight
{
public:
  StrongestWeight() = default;
  /** `weight`: at least 0. */
  StrongestWeight(float weight, bool stiff)
    : Signed(stiff ? -weight : weight)
  {
  }

  float weight() const { return std::fabs(this->Signed); }
  bool stiff() const { return std::signbit(this->Signed); }

private:
  float Signed; // with the sign - if the row is stiff
};

} // namespace smg
