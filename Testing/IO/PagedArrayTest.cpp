// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/PagedArray.h"
#include "IO/Formats/Vsm/PackedIntegers.h"
#include "Solver/Storage/ScratchAccount.h"
#include "Solver/Storage/ScratchFolder.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace smg::testing
{
namespace
{

TEST(PackedIntegers, GiveBackAllNumbers)
{
  Random random(1);
  for (int width = 0; width <= 64; width++)
  {
    std::vector<std::uint64_t> values(100);
    for (std::uint64_t& value : values)
    {
      value = width == 0 ? 0 : random.bits() >> (64 - width);
    }
    std::vector<std::byte> packed;
    packIntegers(values, packed);
    EXPECT_EQ(packed.size(), 1 + 100 * std::size_t((width + 7) / 8));
    std::vector<std::uint64_t> unpacked(100);
    EXPECT_TRUE(unpackIntegers(packed, unpacked));
    EXPECT_EQ(unpacked, values);
    unpacked.resize(101);
    EXPECT_FALSE(unpackIntegers(packed, unpacked) && width > 0);
    const std::int64_t signedValue = std::int64_t(values[7]);
    EXPECT_EQ(unzigzag(zigzag(signedValue)), signedValue);
    EXPECT_EQ(unzigzag(zigzag(-signedValue)), -signedValue);
  }
}

TEST(PagedArray, IsAnArrayInLittleMemory)
{
  const TemporaryFolder parent;
  const ScratchFolder folder(parent.path());
  constexpr std::int64_t size = 300000;
  PagedArray<std::int64_t> paged(folder.path(), 1);
  std::vector<std::int64_t> plain(size);
  Random random(2);
  std::int64_t kept = 0;
  for (std::int64_t i = 0; i < 200000; i++)
  {
    const std::int64_t place = std::max(kept, random.below(size));
    if (i % 3 == 0)
    {
      ASSERT_EQ(paged.get(place), plain[place]);
    }
    else
    {
      paged.at(place) += i;
      plain[place] += i;
    }
    if (i % 20000 == 19999)
    {
      kept += 12345;
      paged.discardBelow(kept);
    }
  }
  EXPECT_GT(folder.account().peak(), 0);
  EXPECT_EQ(parent.entries(), 1) << "there is a folder for the scratch file already";
}

TEST(PagedArray, MakesAFolderForItsScratchFile)
{
  const TemporaryFolder folder;
  const std::int64_t before = ScratchAccount::process().used();
  {
    PagedArray<std::int64_t> paged(folder.path(), 1);
    paged.at(0) = 1;
    EXPECT_EQ(folder.entries(), 0);
    for (std::int64_t i = 0; i < 100000; i++)
    {
      paged.at(i) = i;
    }
    EXPECT_EQ(folder.entries(), 1);
    EXPECT_GT(ScratchAccount::process().used(), before);
  }
  EXPECT_EQ(folder.entries(), 0);
  EXPECT_EQ(ScratchAccount::process().used(), before);
}

} // namespace
} // namespace smg::testing
