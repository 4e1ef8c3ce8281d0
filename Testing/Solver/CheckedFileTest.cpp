// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/CheckedFile.h"
#include "Solver/Files/VertexFile.h"
#include "Testing/Support/FlippedRead.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

namespace smg::testing
{
namespace
{

constexpr auto Grain = static_cast<std::int64_t>(CheckedFile::GrainBytes);

std::vector<std::byte> randomBytes(Random& random, std::int64_t count)
{
  std::vector<std::byte> bytes(static_cast<std::size_t>(count));
  std::ranges::generate(bytes, [&random] { return static_cast<std::byte>(random.bits()); });
  return bytes;
}

/** Appends parts of any size; returns all. */
std::vector<std::byte> fill(CheckedFile& file, Random& random)
{
  std::vector<std::byte> all;
  for (const std::int64_t most : { std::int64_t(10), Grain, 5 * Grain, std::int64_t(2) })
  {
    for (int i = 0; i < 10; ++i)
    {
      // Some are whole grains, and some empty.
      const std::int64_t count = i == 0 ? most - std::ssize(all) % most : random.below(most);
      const std::vector<std::byte> part = randomBytes(random, count);
      file.append(part);
      all.insert(all.end(), part.begin(), part.end());
    }
  }
  return all;
}

void expectEqualReads(const CheckedFile& file, const std::vector<std::byte>& all, Random& random)
{
  ASSERT_EQ(file.size(), std::ssize(all));
  for (int i = 0; i < 300; ++i)
  {
    const std::int64_t begin =
      i % 3 == 0 ? random.below(file.size() / Grain) * Grain : random.below(file.size());
    const std::int64_t count = i % 5 == 0 ? file.size() - begin : random.below(file.size() - begin);
    std::vector<std::byte> bytes(static_cast<std::size_t>(count));
    file.read(begin, bytes);
    ASSERT_TRUE(std::ranges::equal(
      bytes, std::span(all).subspan(static_cast<std::size_t>(begin), bytes.size())));
  }
}

} // namespace

TEST(CheckedFile, IsReadAnywhere)
{
  const TemporaryFolder folder;
  Random random(3);
  CheckedFile file;
  EXPECT_FALSE(file.isOpen());
  file.create(folder.path());
  expectEqualReads(file, fill(file, random), random);
  file.restart();
  expectEqualReads(file, fill(file, random), random);
  EXPECT_EQ(folder.entries(), 0) << "the file has a name";
}

TEST(CheckedFile, ReadsEndWithGrains)
{
  EXPECT_EQ(CheckedFile::untilGrain(0, 3 * Grain + 5), 3 * Grain);
  EXPECT_EQ(CheckedFile::untilGrain(7, 3 * Grain), 3 * Grain - 7);
  EXPECT_EQ(CheckedFile::untilGrain(Grain - 1, 2), 1);
  EXPECT_EQ(CheckedFile::untilGrain(Grain, Grain - 1), Grain - 1);
}

TEST(CheckedFile, NoticesEachFlippedBit)
{
  const TemporaryFolder folder;
  Random random(5);
  CheckedFile file;
  file.create(folder.path());
  const std::vector<std::byte> all = fill(file, random);
  std::vector<std::byte> bytes(all.size());
  expectNoticedFlips(4,
    [&]
    {
      file.read(0, bytes);
      file.read(5, std::span(bytes).first(1));
      // Parts of two grains and whole ones between them.
      file.read(Grain - 1, std::span(bytes).first(2 * CheckedFile::GrainBytes + 2));
    });
}

TEST(VertexFile, NoticesEachFlippedBit)
{
  const TemporaryFolder place;
  const ScratchFolder folder(place.path());
  Pool pool(1 << 20);
  IoStatistics traffic;
  VertexFile file({ pool, &folder, traffic }, 3);
  const std::vector<double> values(3 * 2000, 0.5);
  file.append(values);
  std::vector<double> read(3 * 100);
  expectNoticedFlips(20,
    [&]
    {
      for (std::int64_t first = 0; first < 2000; first += 100)
      {
        file.read(first, 100, read.data());
      }
    });
}

} // namespace smg::testing
