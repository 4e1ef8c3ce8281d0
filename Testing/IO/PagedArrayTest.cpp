// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/PagedArray.h"
#include "IO/Formats/Vsm/PackedIntegers.h"
#include "Solver/Files/ScratchAccount.h"
#include "Solver/Files/ScratchFolder.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <malloc.h>

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

/** A window that moves along a long array takes no more of the file than at first. */
TEST(PagedArray, ReusesTheFileOfDiscardedPages)
{
  const TemporaryFolder parent;
  const ScratchFolder folder(parent.path());
  PagedArray<std::int64_t> paged(folder.path(), 1);
  constexpr std::int64_t Window = 40000;
  for (std::int64_t i = 0; i < 20 * Window; i++)
  {
    paged.at(i) = i;
    if (i >= Window)
    {
      ASSERT_EQ(paged.get(i - Window), i - Window);
      paged.discardBelow(i - Window);
    }
  }
  EXPECT_GT(folder.account().peak(), 0);
  EXPECT_LE(folder.account().peak(), 2 * Window * std::int64_t(sizeof(std::int64_t)));
}

/** The tables of a page far away take more than the memory allows for all: the pages give way. */
TEST(PagedArray, HasNoMorePagesThanItsTablesLeaveRoomFor)
{
  constexpr std::int64_t PerPage = PageFile::PageBytes / sizeof(std::int64_t);
  constexpr std::int64_t Memory = std::int64_t(8) << 20;
  const TemporaryFolder folder;
  PagedArray<std::int64_t> paged(folder.path(), Memory);
  constexpr std::int64_t FarPage = std::int64_t(1) << 22, TableBytes = 4 * FarPage;
  const auto inUse = []
  {
    const struct mallinfo2 heap = ::mallinfo2();
    return static_cast<std::int64_t>(heap.uordblks + heap.hblkhd);
  };
  const std::int64_t before = inUse();
  for (std::int64_t page = 0; page < Memory / std::int64_t(PageFile::PageBytes); ++page)
  {
    paged.at(page * PerPage) = page;
  }
  ASSERT_EQ(paged.get(FarPage * PerPage), 0);
  EXPECT_LT(inUse() - before, TableBytes + Memory / 8);
  for (std::int64_t page = 0; page < Memory / std::int64_t(PageFile::PageBytes); ++page)
  {
    ASSERT_EQ(paged.get(page * PerPage), page);
  }
}

} // namespace
} // namespace smg::testing
