// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/HilbertCurve.h"

#include <bit>

namespace smg
{

namespace
{

/** Rotates three bits left by `count` positions. */
unsigned turned(unsigned bits, int count)
{
  count %= 3;
  return ((bits << count) | (bits >> (3 - count))) & 7;
}

struct Step
{
  unsigned digit; ///< the position of the octant on the curve
  unsigned state; ///< in the octant
};

/**
 * One level of the curve (C. Hamilton, Compact Hilbert Indices, 2006). A state is the direction of
 * the curve times eight and the corner that it enters at.
 */
Step step(unsigned state, unsigned octant)
{
  const int direction = static_cast<int>(state / 8);
  const unsigned entry = state % 8;
  const unsigned gray = turned(octant ^ entry, 2 - direction);
  const unsigned digit = gray ^ gray >> 1 ^ gray >> 2;
  if (digit == 0)
  {
    return { 0, static_cast<unsigned>((direction + 1) % 3) * 8 + entry };
  }
  const unsigned even = (digit - 1) / 2 * 2;
  const int turn = std::countr_one(digit % 2 == 0 ? digit - 1 : digit) % 3;
  const unsigned nextEntry = entry ^ turned(even ^ even >> 1, direction + 1);
  return { digit, static_cast<unsigned>((direction + turn + 1) % 3) * 8 + nextEntry };
}

} // namespace

HilbertCurve::HilbertCurve()
{
  for (unsigned state = 0; state < States; ++state)
  {
    for (unsigned place = 0; place < 64; ++place)
    {
      const unsigned coarse = (place >> 1 & 1) | (place >> 3 & 1) << 1 | (place >> 5 & 1) << 2;
      const unsigned fine = (place & 1) | (place >> 2 & 1) << 1 | (place >> 4 & 1) << 2;
      const Step first = step(state, coarse);
      const Step second = step(first.state, fine);
      this->Steps[state * 64 + place] =
        static_cast<std::uint16_t>(second.state * 64 + first.digit * 8 + second.digit);
    }
  }
}

} // namespace smg
