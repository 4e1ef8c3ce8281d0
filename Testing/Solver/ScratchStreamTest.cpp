// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/ScratchStream.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

/** Block `index` of generation `generation`: 0 to 2000 numbers that identify both. */
std::vector<std::int32_t> blockOf(int generation, int index)
{
  return std::vector<std::int32_t>((index * 37 + generation) % 2000, 1000 * generation + index);
}

void append(ScratchStream& stream, int generation, int index)
{
  stream.append(std::as_bytes(std::span<const std::int32_t>(blockOf(generation, index))));
}

std::vector<std::int32_t> readNext(ScratchStream& stream)
{
  std::vector<std::int32_t> block(stream.nextBytes() / 4);
  stream.read(std::as_writable_bytes(std::span(block)));
  return block;
}

/** Bytes of the open files, with or without a name, of a folder. */
std::uintmax_t bytesOpenIn(const TemporaryFolder& folder)
{
  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
  {
    std::error_code gone;
    const std::string target = std::filesystem::read_symlink(entry, gone).string();
    if (!gone && target.starts_with(folder.path().string()))
    {
      bytes += std::filesystem::file_size(entry);
    }
  }
  return bytes;
}

} // namespace

TEST(ScratchStream, APassReadsWhatTheLastRewritingPassWrote)
{
  constexpr int Blocks = 50;
  const TemporaryFolder folder;
  IoStatistics statistics;
  {
    ScratchStream stream(folder / "stream", statistics);
    stream.startPass(true);
    for (int i = 0; i < Blocks; ++i)
    {
      append(stream, 0, i);
    }
    stream.endPass();
    int generation = 0;
    for (const bool rewrite : { false, true, true, false, true, false })
    {
      stream.startPass(rewrite);
      for (int i = 0; i < Blocks; ++i)
      {
        EXPECT_EQ(readNext(stream), blockOf(generation, i));
        // Written with a delay, like windows.
        if (rewrite && i >= 3)
        {
          append(stream, generation + 1, i - 3);
        }
      }
      for (int i = Blocks - 3; rewrite && i < Blocks; ++i)
      {
        append(stream, generation + 1, i);
      }
      stream.endPass();
      generation += rewrite ? 1 : 0;
      EXPECT_EQ(folder.entries(), 0);
    }
    EXPECT_GT(statistics.bytesRead, 0);
    EXPECT_GT(statistics.bytesWritten, 0);
  }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(ScratchStream, AnyBlockCanBeReadBetweenPasses)
{
  const TemporaryFolder folder;
  IoStatistics statistics;
  ScratchStream stream(folder / "stream", statistics);
  stream.startPass(true);
  for (int i = 0; i < 20; ++i)
  {
    append(stream, 5, i);
  }
  stream.endPass();
  for (const int i : { 13, 2, 19, 0, 13 })
  {
    std::vector<std::int32_t> block(stream.bytes(i) / 4);
    stream.read(i, std::as_writable_bytes(std::span(block)));
    EXPECT_EQ(block, blockOf(5, i));
  }
}

TEST(ScratchStream, PlacesOfTheGenerationBeforeAreUsedAgain)
{
  const TemporaryFolder folder;
  IoStatistics statistics;
  ScratchStream stream(folder / "stream", statistics);
  for (const int size : { 1000, 1000, 0, 700, 1000 })
  {
    stream.startPass(true);
    for (int i = 0; i < 8; ++i)
    {
      stream.append(std::vector<std::byte>(static_cast<std::size_t>(size + i)));
    }
    stream.endPass();
    EXPECT_LE(bytesOpenIn(folder), 2 * (8 * 1000 + 28)) << size;
  }
}

TEST(ScratchStream, AnAbandonedPassLeavesNoFile)
{
  const TemporaryFolder folder;
  IoStatistics statistics;
  {
    ScratchStream stream(folder / "stream", statistics);
    stream.startPass(true);
    append(stream, 0, 7);
  }
  EXPECT_EQ(folder.entries(), 0);
  {
    ScratchStream stream(folder / "stream", statistics);
    stream.startPass(true);
    append(stream, 0, 7);
    stream.endPass();
    stream.startPass(true);
    append(stream, 1, 7);
  }
  EXPECT_EQ(folder.entries(), 0);
}

} // namespace smg::testing
