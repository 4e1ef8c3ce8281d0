// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/ColumnSelection.h"
#include "Testing/Support/StreamMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

/** The text on a column that is read in blocks of so many numbers, where `sought` is selected. */
template <class T>
std::string textOn(const std::vector<T>& numbers, std::size_t block, T sought)
{
  TagValues values;
  for (std::size_t begin = 0; begin < numbers.size(); begin += block)
  {
    const std::size_t end = std::min(numbers.size(), begin + block);
    const std::vector<T> part(numbers.data() + begin, numbers.data() + end);
    std::vector<std::uint8_t> selected;
    for (const T number : part)
    {
      selected.push_back(number == sought ? 1 : 0);
    }
    values.add(makeColumn<T>("part", part), selected);
  }
  return values.text();
}

} // namespace

TEST(TagValues, AreNamedInAscendingOrderWhateverTheBlocks)
{
  for (const std::size_t block : { 1, 2, 3, 100 })
  {
    EXPECT_EQ(textOn<int>({ 12, 3, 3, -2, 12, 1 }, block, 7), ": its values are -2, 1, 3 and 12");
    EXPECT_EQ(textOn<int>({ 5, 5, 5 }, block, 7), ": its only value is 5");
    EXPECT_EQ(textOn<int>({ 12, 3, 7, 1 }, block, 7), "");
    EXPECT_EQ(textOn<int>({}, block, 7), "");
  }
}

TEST(TagValues, HaveThePrecisionOfTheColumn)
{
  EXPECT_EQ(textOn<float>({ 0.1F, 2.0F, NAN }, 1, 0.5F), ": its values are 0.1 and 2");
  EXPECT_EQ(textOn<double>({ 1e-30, 100000.0 }, 1, 0.5), ": its values are 1e-30 and 100000");
  EXPECT_EQ(textOn<double>({ NAN, NAN }, 1, 0.5), "");
}

TEST(TagValues, OfManyTheSmallestAreNamedAndOfVeryManyTheRange)
{
  std::vector<int> numbers;
  for (int i = 0; i < 1000; ++i)
  {
    numbers.push_back(i * 7919 % 1000 + 5);
  }
  EXPECT_EQ(textOn<int>(numbers, 64, 3),
    ": the smallest of its 1000 values are 5, 6, 7, 8, 9, 10, 11, 12, 13, 14");
  numbers.insert(numbers.begin() + 500, 4);
  EXPECT_EQ(textOn<int>(numbers, 64, 3), ": its values, more than 1000, are from 4 to 1004");
  numbers.insert(numbers.end(), { 2, 90000 });
  EXPECT_EQ(textOn<int>(numbers, 64, 3), ": its values, more than 1000, are from 2 to 90000");
  numbers.push_back(3);
  EXPECT_EQ(textOn<int>(numbers, 64, 3), "");
}

} // namespace smg::testing
