// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/** Counts the places where several points of the boundary lie, as along a seam between patches with
 * vertices of their own. Of many, a sample of the places is remembered, chosen by a hash of the
 * coordinates, so that coincident points are chosen together. */
class SeamPoints
{
public:
  void add(const double* point);
  /** Adds the points of another part of the boundary. */
  void add(const SeamPoints& other);

  /** An estimate unless isExact(). */
  std::int64_t places() const;
  bool isExact() const { return this->Shift == 0; }

  template <class State>
  void exchange(State& state)
  {
    state(this->Shift, this->Sample);
  }

private:
  bool isChosen(std::uint64_t place) const
  {
    return (place & ((std::uint64_t(1) << this->Shift) - 1)) == 0;
  }
  void thin();

  std::int64_t Shift = 0; ///< of 2^Shift places, one is remembered
  std::vector<std::uint64_t> Sample;
};

} // namespace smg
