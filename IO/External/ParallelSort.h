// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace smg
{

namespace parallelsort
{

/** Fewer records are sorted by one thread. */
inline constexpr std::ptrdiff_t LeastRecords = 1 << 14;

/** Moves the records before the median of a sample to the front; returns their end. */
template <class Record, class Less>
Record* divide(Record* begin, Record* end, const Less& less)
{
  std::array<Record, 31> sample;
  const std::ptrdiff_t step = (end - begin) / std::ssize(sample);
  for (std::ptrdiff_t i = 0; i < std::ssize(sample); ++i)
  {
    sample[static_cast<std::size_t>(i)] = begin[i * step];
  }
  const auto middle = sample.begin() + sample.size() / 2;
  std::nth_element(sample.begin(), middle, sample.end(), less);
  return std::partition(begin, end, [&](const Record& record) { return less(record, *middle); });
}

} // namespace parallelsort

/** Sorts records by `less`, a strict order without ties, so that the result is unique: quicksort,
 * whose parts are divided further and sorted on all threads. */
template <class Record, class Less>
void parallelSort(Workers& workers, Record* begin, Record* end, Less less)
{
  std::vector<Record*> ends{ begin, end }; // of the parts
  const auto parts = [&ends] { return static_cast<int>(ends.size()) - 1; };
  const int wanted = workers.threads() > 1 ? 2 * workers.threads() : 1;
  while (parts() < wanted && (end - begin) / parts() >= 2 * parallelsort::LeastRecords)
  {
    std::vector<Record*> divided(ends.size() + static_cast<std::size_t>(parts()), end);
    runAll(workers, parts(),
      [&](int part)
      {
        const auto p = static_cast<std::size_t>(part);
        divided[2 * p] = ends[p];
        divided[2 * p + 1] = ends[p + 1] - ends[p] < parallelsort::LeastRecords
                               ? ends[p + 1]
                               : parallelsort::divide(ends[p], ends[p + 1], less);
      });
    ends = std::move(divided);
  }
  runAll(workers, parts(),
    [&](int part)
    {
      const auto p = static_cast<std::size_t>(part);
      std::sort(ends[p], ends[p + 1], less);
    });
}

} // namespace smg
