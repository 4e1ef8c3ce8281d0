// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Components.h"
#include "smg/Export.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace smg
{

/** Finds what lies at the same place. Of very much only a sample of the places is remembered,
 * chosen by a hash of the coordinates, so that what coincides is chosen together. So the memory is
 * bounded, and what is found depends on neither blocks nor threads. */
class SMG_EXPORT PlaceSample
{
public:
  struct Entry
  {
    std::uint64_t place; ///< hash of the coordinates
    std::int32_t label;
  };

  /** `most`: the number of entries that are remembered. */
  explicit PlaceSample(std::size_t most)
    : Most(most)
  {
  }

  static std::uint64_t placeOf(const double* point);
  static std::uint64_t placeOf(std::array<std::uint64_t, 3> corners); ///< in any order
  void add(std::uint64_t place, std::int32_t label);
  /** Of 2^shift() places, one is remembered. */
  int shift() const { return this->Shift; }
  const std::vector<Entry>& entries() const { return this->Sample; }

  /** Calls visit(entries) for each place of some entries, which it sorts by places and labels. */
  template <class Visit>
  static void forPlaces(std::vector<Entry>& entries, Visit&& visit)
  {
    std::ranges::sort(entries, {}, [](const Entry& e) { return std::tuple(e.place, e.label); });
    for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end)
    {
      while (end < entries.size() && entries[end].place == entries[begin].place)
      {
        ++end;
      }
      visit(std::span<const Entry>(entries).subspan(begin, end - begin));
    }
  }

private:
  void halve();

  std::size_t Most;
  int Shift = 0;
  std::vector<Entry> Sample;
};

/** Finds vertices of different components that lie at the same place: bodies that look connected
 * there and are not. The count of a large mesh is an estimate. */
class SMG_EXPORT CoincidentPoints
{
public:
  struct Count
  {
    std::int64_t places = 0;
    bool isExact = true;
  };

  /** `most`: the number of vertices that are remembered. */
  explicit CoincidentPoints(std::size_t most = std::size_t(1) << 16)
    : Places(most)
  {
  }

  /** Adds a vertex with the label of its component. */
  void add(const double* point, std::int32_t label)
  {
    this->Places.add(PlaceSample::placeOf(point), label);
  }
  /** The number of places with vertices of several components. */
  Count count(const Components& components) const;

private:
  PlaceSample Places;
};

} // namespace smg
