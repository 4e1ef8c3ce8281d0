// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/RowBlock.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "Solver/Multigrid/Setup/GatheredRows.h"
#include "Solver/Multigrid/Setup/LevelRows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace smg::testing
{

TEST(InterpolationEntry, FindsRowsAndCoarseNodesFromAnyNearOne)
{
  for (const std::int64_t place : { std::int64_t(0), std::int64_t(1) << 24, std::int64_t(1) << 29,
         (std::int64_t(1) << 32) - 5, (std::int64_t(3) << 33) + 17 })
  {
    for (const std::int64_t distance : { -8000000, -1, 0, 1, 8000000 })
    {
      const std::int64_t near = place + distance;
      EXPECT_EQ(ChildLink(place, 6).row(near), place);
      EXPECT_EQ(ChildLink(place, 6).slot(), 6);
      for (const int quanta : { -127, -1, 1, 127 })
      {
        const InterpolationEntry entry(static_cast<CoarseIndex>(place), quanta);
        EXPECT_EQ(near + entry.offset(near), place);
        EXPECT_EQ(entry.quanta(), quanta);
        EXPECT_EQ(entry.weight(), static_cast<float>(quanta) * Quantum);
      }
    }
  }
  EXPECT_TRUE(ChildLink().none());
  EXPECT_FALSE(ChildLink(std::int64_t(1) << 29, 6).none());
}

TEST(CoarseEntry, FindsCoarseNodesFromAnyNearOne)
{
  for (const std::int64_t place : { std::int64_t(0), std::int64_t(1) << 24, std::int64_t(1) << 29,
         (std::int64_t(1) << 32) - 5, (std::int64_t(3) << 33) + 17 })
  {
    for (const std::int64_t distance :
      { 1 - CoarseWindow, std::int64_t(-1), std::int64_t(0), std::int64_t(1), CoarseWindow - 1 })
    {
      for (const float value : { -1.5F, 0.0F, 3e30F })
      {
        const CoarseEntry entry(static_cast<CoarseIndex>(place), value);
        EXPECT_EQ(place + distance + entry.offset(place + distance), place);
      }
    }
  }
}

TEST(CoarseEntry, KeepsFloats)
{
  std::vector<CoarseEntry> entries;
  for (int k = 0; k < 1000; ++k)
  {
    const float value = (k % 2 == 0 ? 1.0F : -1.0F) * std::exp(0.05F * static_cast<float>(k - 500));
    entries.emplace_back(static_cast<CoarseIndex>(k), value);
    EXPECT_EQ(entries.back().value(), value);
  }
  // Changing one does not affect its neighbours.
  const float before = entries[499].value();
  const float after = entries[501].value();
  entries[500].setValue(-0.25F);
  EXPECT_EQ(entries[500].value(), -0.25F);
  EXPECT_EQ(entries[500].offset(0), 500);
  EXPECT_EQ(entries[499].value(), before);
  EXPECT_EQ(entries[501].value(), after);
  EXPECT_EQ(entries[501].offset(0), 501);

  entries[500].remove();
  EXPECT_TRUE(entries[500].removed());
  EXPECT_EQ(entries[500].offset(0), 500);
  EXPECT_FALSE(entries[499].removed() || entries[501].removed());
  entries[502].takeValue(entries[500]);
  EXPECT_TRUE(entries[502].removed());
  EXPECT_EQ(entries[502].offset(0), 502);
  entries[500].setValue(0.0F);
  EXPECT_FALSE(entries[500].removed());
  EXPECT_EQ(entries[500].value(), 0.0F);
}

TEST(StrongestWeight, IsStiffWhateverTheWeight)
{
  for (const float weight : { 0.0F, 1.0F / 3.0F, 7e30F })
  {
    for (const bool stiff : { false, true })
    {
      EXPECT_EQ(StrongestWeight(weight, stiff).weight(), weight);
      EXPECT_EQ(StrongestWeight(weight, stiff).stiff(), stiff);
    }
  }
}

TEST(RowEntry, KeepsDistanceAndWeight)
{
  constexpr auto Most = static_cast<std::int32_t>(RowEntry::MaxDistance);
  for (const std::int32_t delta : { -Most, -257, -1, 1, 256, Most })
  {
    for (const float weight : { 0.0F, 1.0F / 3.0F, -7e-30F })
    {
      const RowEntry entry(delta, weight);
      EXPECT_EQ(entry.delta(), delta);
      EXPECT_EQ(entry.weight(), weight);
    }
  }
}

TEST(WideIndex, KeepsAsManyBitsAsARowEntry)
{
  constexpr auto Most = static_cast<std::int32_t>(RowEntry::MaxDistance);
  const std::vector<std::int32_t> expected = { -Most - 1, Most, -1, 0, -257, 255, 32768 };
  for (const int before : { 0, 255 })
  {
    // As in a block, they are preceded by other data.
    std::vector<std::uint8_t> bytes(8 + expected.size() * sizeof(WideIndex));
    bytes[7] = static_cast<std::uint8_t>(before);
    auto* index = reinterpret_cast<WideIndex*>(bytes.data() + 8);
    std::ranges::transform(expected, index, [](std::int32_t value) { return WideIndex(value); });
    for (std::size_t e = 0; e < expected.size(); ++e)
    {
      EXPECT_EQ(index[e], expected[e]);
    }
  }
}

} // namespace smg::testing
