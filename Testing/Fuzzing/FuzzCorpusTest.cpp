// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/BlockFile.h"
#include "Testing/Fuzzing/FuzzTargets.h"
#include "Testing/Support/TestFolders.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

using namespace smg;
using namespace smg::testing;

namespace
{

struct Seed
{
  std::string name;
  std::string bytes;
};

/** The files of a target's corpus, by name. */
std::vector<Seed> corpusOf(const FuzzTarget& target)
{
  const auto folder = sourceFolder() / "Testing" / "Fuzzing" / "corpus" / target.name;
  std::vector<Seed> corpus;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    std::ifstream stream(entry.path(), std::ios::binary);
    corpus.push_back(
      { entry.path().filename().string(), { std::istreambuf_iterator<char>(stream), {} } });
  }
  std::ranges::sort(corpus, {}, &Seed::name);
  return corpus;
}

/** The bytes with some of them changed, removed or doubled. */
std::string mutated(std::string bytes, Random& random)
{
  const auto place = [&]
  { return static_cast<std::size_t>(random.below(static_cast<std::int64_t>(bytes.size()))); };
  for (std::int64_t changes = 1 + random.below(4); changes > 0 && !bytes.empty(); --changes)
  {
    switch (random.below(4))
    {
      case 0:
        bytes[place()] = static_cast<char>(random.below(256));
        break;
      case 1:
        bytes[place()] = "0123456789-.e \n"[random.below(15)];
        break;
      case 2:
        bytes.erase(place(), static_cast<std::size_t>(1 + random.below(16)));
        break;
      default:
        const std::string part = bytes.substr(place(), static_cast<std::size_t>(random.below(16)));
        bytes.insert(place(), part);
    }
  }
  return bytes;
}

/** The finding of a target for the bytes; empty if there is none. */
std::string findingOf(const FuzzTarget& target, std::string_view bytes)
{
  try
  {
    target.run(bytes, choiceFor(bytes));
    return {};
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
}

/** The bytes of a changed .vsm file with the length of its header in JSON, which comes after the
 * front, and the place of its index; other files as they are. */
std::string withHeaderBytes(std::string changed, std::string_view before)
{
  if (changed.starts_with(BlockFileMagic) && changed.size() >= sizeof(BlockFileFront))
  {
    BlockFileFront front{};
    std::memcpy(&front, changed.data(), sizeof(front));
    front.headerBytes +=
      static_cast<std::int64_t>(changed.size()) - static_cast<std::int64_t>(before.size());
    std::memcpy(changed.data(), &front, sizeof(front));
  }
  return changed;
}

class FuzzCorpus : public ::testing::TestWithParam<FuzzTarget>
{
};

} // namespace

// A file whose name begins with "refused" is damaged: it once exposed a defect, or cannot be read.
TEST_P(FuzzCorpus, IsReadUnlessItIsDamaged)
{
  const std::vector<Seed> corpus = corpusOf(GetParam());
  EXPECT_GE(corpus.size(), 5U);
  for (const Seed& seed : corpus)
  {
    EXPECT_EQ(GetParam().run(seed.bytes, CellChoice::Only), !seed.name.starts_with("refused"))
      << seed.name;
  }
}

TEST_P(FuzzCorpus, CutOffAnywhereIsRefusedOrValid)
{
  const std::size_t steps = GetParam().solves ? 6 : 30;
  for (const Seed& seed : corpusOf(GetParam()))
  {
    const std::size_t step = seed.bytes.size() / steps + 1;
    for (std::size_t length = 0; length <= seed.bytes.size(); length += step)
    {
      EXPECT_EQ(findingOf(GetParam(), std::string_view(seed.bytes).substr(0, length)), "")
        << seed.name << ", the first " << length << " bytes";
    }
  }
}

TEST_P(FuzzCorpus, DamagedAnywhereIsRefusedOrValid)
{
  const int mutations = GetParam().solves ? 6 : 24;
  for (const Seed& seed : corpusOf(GetParam()))
  {
    for (int i = 0; i < mutations; ++i)
    {
      Random random(static_cast<std::uint64_t>(i));
      EXPECT_EQ(findingOf(GetParam(), mutated(seed.bytes, random)), "")
        << seed.name << ", mutation " << i;
    }
  }
}

// Each number in the text of a file, also in the header of a container, whose checksums are
// corrected, becomes three of those that must not be believed, in turn.
TEST_P(FuzzCorpus, WithAnyNumberIsRefusedOrValid)
{
  const std::size_t most = GetParam().solves ? 12 : 40;
  constexpr std::array numbers{ "0", "-1", "1.5", "1e300", "4294967296", "4611686018427387904",
    "9223372036854775807", "18446744073709551615" };
  for (const Seed& seed : corpusOf(GetParam()))
  {
    std::size_t at = 0;
    for (std::size_t k = 0; k < most; ++k)
    {
      const auto isDigit = [](unsigned char c) { return std::isdigit(c) != 0; };
      const auto begin =
        std::find_if(seed.bytes.begin() + std::ptrdiff_t(at), seed.bytes.end(), isDigit);
      const auto end = std::find_if_not(begin, seed.bytes.end(), isDigit);
      if (begin == end)
      {
        break;
      }
      at = static_cast<std::size_t>(end - seed.bytes.begin());
      for (std::size_t i = 3 * k; i < 3 * k + 3; ++i)
      {
        const std::string_view number = numbers[i % numbers.size()];
        std::string changed(seed.bytes.begin(), begin);
        changed.append(number).append(end, seed.bytes.end());
        // A .vsm file says the length of its header.
        EXPECT_EQ(findingOf(GetParam(), withHeaderBytes(changed, seed.bytes)), "")
          << seed.name << ", byte " << begin - seed.bytes.begin() << ": " << number;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, FuzzCorpus,
  ::testing::ValuesIn(fuzzTargets().begin(), fuzzTargets().end()),
  [](const auto& instance) { return std::string(instance.param.name); });
