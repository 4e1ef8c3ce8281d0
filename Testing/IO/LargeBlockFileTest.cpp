// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/SparseBlockFile.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg::testing
{
namespace
{

std::vector<std::byte> randomNumbers(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  std::vector<std::uint64_t> values(count);
  std::ranges::generate(values, [&random] { return random.bits(); });
  const auto bytes = std::as_bytes(std::span(values));
  return { bytes.begin(), bytes.end() };
}

} // namespace

/** Blocks that lie across 2^31, 2^32 and 2^33 bytes of the file. */
TEST(LargeBlockFile, IsReadWhereverABlockLies)
{
  constexpr std::int64_t Rows = 1000, HoleBytes = std::int64_t(1) << 30;
  constexpr int Bits[] = { 31, 32, 33 };
  const TemporaryFolder folder;
  SparseBlockFile file(folder / "large", { { "values", { { "Value", ScalarType::UInt64, 1 } } } });
  std::vector<std::int64_t> blocks;
  std::int64_t block = 0;
  for (const int bits : Bits)
  {
    const std::int64_t place = (std::int64_t(1) << bits) - 96;
    for (; file.end() < place; ++block)
    {
      const std::int64_t bytes = std::min(HoleBytes, place - file.end());
      file.addHole(0, bytes / 8, static_cast<std::uint32_t>(bytes));
    }
    file.add(0, Rows, { randomNumbers(Rows, bits) });
    blocks.push_back(block++);
  }
  file.finish("{}");
  ASSERT_GT(std::filesystem::file_size(folder / "large"), std::uint64_t(1) << 33);

  BlockFileReader reader(folder / "large");
  EXPECT_EQ(reader.blocks(0), block);
  for (const bool ahead : { false, true })
  {
    for (std::size_t k = 0; k < blocks.size(); ++k)
    {
      if (ahead)
      {
        reader.prefetch(0, blocks[k]);
      }
      std::vector<std::byte> bytes(8 * Rows);
      reader.read(0, blocks[k], 0, bytes);
      EXPECT_EQ(bytes, randomNumbers(Rows, Bits[k])) << Bits[k];
    }
  }
}

/** Rows are numbered beyond 2^31 and 2^32, in the file and by the writer. */
TEST(LargeBlockFile, FindsTheBlockOfEachRow)
{
  constexpr std::int64_t Step = (std::int64_t(1) << 31) - 100;
  const TemporaryFolder folder;
  const std::vector<TableSpec> tables{ { "opaque", { { "Bytes", ScalarType::UInt8, 0 } } } };
  {
    BlockFileWriter writer(folder / "rows", tables, Codec::None);
    for (std::int64_t b = 0; b < 5; ++b)
    {
      const std::vector<std::byte> bytes(10, std::byte(b));
      const std::span<const std::byte> column(bytes);
      writer.append(0, Step, { &column, 1 });
    }
    writer.finish("{}");
  }
  BlockFileReader reader(folder / "rows");
  EXPECT_EQ(reader.rows(0), 5 * Step);
  for (std::int64_t b = 0; b < 5; ++b)
  {
    EXPECT_EQ(reader.firstRow(0, b), b * Step);
    EXPECT_EQ(reader.blockRows(0, b), Step);
    EXPECT_EQ(reader.blockOf(0, b * Step), b);
    EXPECT_EQ(reader.blockOf(0, (b + 1) * Step - 1), b);
    std::vector<std::byte> bytes(10);
    reader.read(0, b, 0, bytes);
    EXPECT_EQ(bytes, std::vector<std::byte>(10, std::byte(b)));
  }
}

} // namespace smg::testing
