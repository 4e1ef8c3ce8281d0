// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/State.h"
#include "Solver/Multigrid/Cycle/IterateHistory.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/FlippedRead.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

struct Row
{
  std::int32_t number = 0;
  bool held = false;
  std::string name;

  template <class State>
  void exchange(State& state)
  {
    state(this->number, this->held, this->name);
  }
  bool operator==(const Row&) const = default;
};

/** Values of every kind. */
struct Sample
{
  double real = 0.0;
  bool flag = false;
  std::string text;
  std::vector<double> numbers;
  std::vector<Row> rows;
  std::vector<std::string> names;
  std::optional<double> given, absent;

  template <class State>
  void exchange(State& state)
  {
    state.part("sample");
    state(this->real, this->flag, this->text, this->numbers);
    state.part("rows");
    state(this->rows, this->names, this->given, this->absent);
  }
  bool operator==(const Sample&) const = default;
};

Sample sample()
{
  Sample sample{ 0.1, true, "text", {}, {}, { "", "a name" }, 2.5, {} };
  sample.numbers.resize(20'000, 3.25); // more than two pages
  sample.rows = { { 1, true, "one" }, { 2, false, "" } };
  return sample;
}

constexpr std::int64_t Offset = 24;

StateReader readerOf(const TemporaryFolder& folder, Pool& pool)
{
  FileDescriptor file = FileDescriptor::openForReading(folder / "state");
  const std::int64_t bytes = file.size() - Offset;
  return StateReader(std::move(file), Offset, bytes, pool);
}

/** Writes the sample; returns the checksum. */
std::uint64_t writeSample(const TemporaryFolder& folder)
{
  const FileDescriptor file = FileDescriptor::openOrCreate(folder / "state");
  StateWriter state(file, Offset);
  Sample written = sample();
  state(written);
  state.finish();
  EXPECT_EQ(state.bytes(), file.size() - Offset);
  return state.checksum();
}

} // namespace

TEST(State, IsReadAsItWasCompared)
{
  const TemporaryFolder folder;
  writeSample(folder);
  Pool pool(1 << 20);
  StateReader state = readerOf(folder, pool);
  state.checksum();
  const FlippedRead flip(1);
  Sample read;
  expectError([&] { state(read); }, "it differs from read to read");
}

TEST(State, NumbersForAnotherNumberOfColumnsAreRefused)
{
  const TemporaryFolder folder;
  const auto check = [&folder](auto written, auto read)
  {
    {
      const FileDescriptor file = FileDescriptor::openOrCreate(folder / "state");
      StateWriter state(file, Offset);
      state(written);
      state.finish();
    }
    Pool pool(1 << 20);
    StateReader state = readerOf(folder, pool);
    expectError([&] { state(read); }, "state");
    std::filesystem::remove(folder / "state");
  };
  check(IterateEnergy(4), IterateEnergy(1));
  check(IterateEnergy(1), IterateEnergy(8));
}

TEST(State, IsReadAsItWasWritten)
{
  const TemporaryFolder folder;
  const std::uint64_t written = writeSample(folder);
  Pool pool(1 << 20);
  StateReader state = readerOf(folder, pool);
  EXPECT_EQ(state.checksum(), written);
  Sample read;
  read.absent = 1.0;
  state(read);
  state.finish();
  EXPECT_TRUE(read == sample());
}

TEST(State, CutOffAnywhereIsAnErrorThatNamesTheFile)
{
  const TemporaryFolder folder;
  writeSample(folder);
  Pool pool(1 << 20);
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(folder / "state"));
  for (std::int64_t bytes = size - 1; bytes >= Offset; bytes -= bytes > 300 ? 9973 : 1)
  {
    std::filesystem::resize_file(folder / "state", static_cast<std::uintmax_t>(bytes));
    StateReader state = readerOf(folder, pool);
    Sample read;
    expectError([&] { state(read); }, (folder / "state").string() + ": the checkpoint is damaged");
  }
}

TEST(State, WithMoreThanWasReadIsAnError)
{
  const TemporaryFolder folder;
  writeSample(folder);
  Pool pool(1 << 20);
  StateReader state = readerOf(folder, pool);
  state.part("sample");
  expectError([&] { state.finish(); }, "damaged");
  StateReader other = readerOf(folder, pool);
  expectError([&] { other.part("rows"); }, "lacks the part 'rows'");
}

TEST(State, NoCountIsBelievedThatTheFileCannotHold)
{
  const TemporaryFolder folder;
  for (const std::uint64_t count : { std::uint64_t(5), std::uint64_t(1) << 32, ~std::uint64_t(0) })
  {
    {
      const FileDescriptor file = FileDescriptor::openOrCreate(folder / "state");
      StateWriter state(file, Offset);
      state(count);
      state.write(std::vector<std::byte>(39));
      state.finish();
    }
    Pool pool(1 << 20);
    std::vector<double> numbers;
    std::vector<std::string> names;
    std::string text;
    const auto read = [&](auto& value)
    {
      StateReader state = readerOf(folder, pool);
      state(value);
    };
    expectError([&] { read(numbers); }, "damaged");
    expectError([&] { read(names); }, "damaged");
    EXPECT_EQ(messageOf([&] { read(text); }).empty(), count == 5);
  }
  Pool small(10);
  expectError([&] { readerOf(folder, small); }, "larger memory limit");
}

} // namespace smg::testing
