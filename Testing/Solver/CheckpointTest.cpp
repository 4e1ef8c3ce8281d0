// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Storage/Checkpoint.h"
#include "Solver/Storage/IoStatistics.h"
#include "Solver/Storage/ScratchStream.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

/** A computation of steps: each rewrites a stream of numbers with the number of the step. */
class Steps
{
public:
  explicit Steps(const std::filesystem::path& folder, const std::string& subject = "a")
    : Folder(KeptFolder{ folder })
    , States(this->Folder, { { "kind", "steps" }, { "letter", subject } })
    , Stream(this->Folder, "numbers", this->Statistics)
  {
  }

  /** Continues from the last state; returns its step, 0: none. */
  int open()
  {
    std::optional<StateReader> state = this->States.open(this->Memory);
    if (state)
    {
      (*state)(this->Step);
      this->Stream.load(*state, Blocks);
      state->finish();
    }
    return this->Step;
  }
  /** Writes the next step without saving it. */
  void write(int blocks = Blocks)
  {
    this->Stream.startPass(true);
    for (int i = 0; i < blocks; ++i)
    {
      const std::vector<int> block(100, this->Step + 1);
      this->Stream.append(std::as_bytes(std::span(block)));
    }
  }
  void step()
  {
    this->write();
    this->Stream.endPass();
    ++this->Step;
    this->States.save(this->Step,
      [this](StateWriter& state)
      {
        state(this->Step);
        this->Stream.save(state);
      });
  }
  void discard() { this->States.discard(); }

private:
  static constexpr int Blocks = 5;

  Pool Memory{ 1 << 20 };
  IoStatistics Statistics;
  ScratchFolder Folder;
  Checkpoint States;
  ScratchStream Stream;
  int Step = 0;
};

void flip(const std::filesystem::path& path, std::int64_t offset)
{
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(offset);
  const int byte = file.get();
  file.seekp(offset);
  file.put(static_cast<char>(byte ^ 1));
}

} // namespace

TEST(Checkpoint, ContinuesFromTheLastState)
{
  const TemporaryFolder folder;
  for (int step = 0; step < 7; ++step)
  {
    EXPECT_EQ(Checkpoint::steps(folder / "ck"), step);
    Steps steps(folder / "ck");
    EXPECT_EQ(steps.open(), step);
    steps.step();
  }
  {
    Steps steps(folder / "ck");
    EXPECT_EQ(steps.open(), 7);
    steps.discard();
  }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Checkpoint, WithoutAStateLeavesNothing)
{
  const TemporaryFolder folder;
  {
    Steps steps(folder / "ck");
    EXPECT_EQ(steps.open(), 0);
    steps.write();
  }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Checkpoint, AStepThatIsNotSavedDoesNotTouchTheLastState)
{
  const TemporaryFolder folder;
  for (int blocks = 0; blocks <= 5; ++blocks)
  {
    Steps steps(folder / "ck");
    EXPECT_EQ(steps.open(), blocks);
    steps.step();
    steps.write(blocks);
  }
}

TEST(Checkpoint, OfAnotherSubjectIsRefusedAndKept)
{
  const TemporaryFolder folder;
  {
    Steps steps(folder / "ck");
    steps.open();
    steps.step();
  }
  for (int k = 0; k < 2; ++k)
  {
    Steps other(folder / "ck", "b");
    expectError([&] { other.open(); }, "another letter");
  }
  Steps same(folder / "ck");
  EXPECT_EQ(same.open(), 1);
}

TEST(Checkpoint, OfAProgramThatRunsIsRefused)
{
  const TemporaryFolder folder;
  Steps steps(folder / "ck");
  expectError([&] { Steps other(folder / "ck"); }, "another program is using this checkpoint");
}

TEST(Checkpoint, InAFolderWithOtherFilesIsRefusedAndTouchesNone)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "mine") << "text";
  expectError([&] { Steps steps(folder.path()); }, "neither empty nor a checkpoint");
  EXPECT_EQ(folder.entries(), 1);
  expectError([&] { Steps steps(folder / "no" / "where"); }, "cannot be made");
}

TEST(Checkpoint, WithALinkIsRefusedAndDoesNotFollowIt)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "mine") << "text";
  const std::filesystem::path kept = folder / "ck";
  {
    Steps steps(kept);
    steps.open();
    steps.step();
  }
  for (const char* name : { "state.1", "numbers", "mesh.vsm" })
  {
    const std::filesystem::path link = kept / name;
    std::filesystem::remove(link);
    std::filesystem::create_symlink(folder / "mine", link);
    expectError([&] { Steps steps(kept); }, "is no file of a checkpoint");
    std::filesystem::remove(link);
    std::filesystem::create_hard_link(folder / "mine", link);
    expectError([&] { Steps steps(kept); }, "is no file of a checkpoint");
    std::filesystem::remove(link);
  }
  std::filesystem::create_directory(folder / "elsewhere");
  std::filesystem::create_directory_symlink(folder / "elsewhere", kept / "stages");
  expectError([&] { Steps steps(kept); }, "is no file of a checkpoint");
  EXPECT_EQ(std::filesystem::file_size(folder / "mine"), 4U);
}

TEST(Checkpoint, UsesTheStateBeforeIfTheLastOneIsDamagedAndItsFilesAreWhole)
{
  const TemporaryFolder folder;
  {
    Steps steps(folder / "ck");
    steps.open();
    steps.step();
    steps.step();
    steps.step();
  }
  const std::filesystem::path last = folder / "ck" / "state.0"; // of steps 1 and 3
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(last));
  for (std::int64_t offset = 0; offset < size; ++offset)
  {
    flip(last, offset);
    {
      Steps steps(folder / "ck");
      EXPECT_EQ(steps.open(), 2) << offset;
    }
    flip(last, offset);
  }
  flip(folder / "ck" / "state.1", 50);
  for (std::int64_t offset = 0; offset < size; ++offset)
  {
    flip(last, offset);
    {
      Steps steps(folder / "ck");
      expectError([&] { steps.open(); }, "damaged");
    }
    flip(last, offset);
  }
}

TEST(Checkpoint, WhoseStateBeforeNoLongerHasItsFilesIsRefused)
{
  const TemporaryFolder folder;
  {
    Steps steps(folder / "ck");
    steps.open();
    steps.step();
    steps.step();
    steps.write(1); // over a block of step 1
  }
  flip(folder / "ck" / "state.1", 60);
  Steps steps(folder / "ck");
  expectError([&] { steps.open(); }, "block 0 of");
}

TEST(Checkpoint, WithADamagedScratchFileIsRefused)
{
  const TemporaryFolder folder;
  {
    Steps steps(folder / "ck");
    steps.open();
    steps.step();
  }
  const std::filesystem::path numbers = folder / "ck" / "numbers";
  for (const std::int64_t offset : { 0, 399, 400, 1999 })
  {
    flip(numbers, offset);
    {
      Steps steps(folder / "ck");
      expectError([&] { steps.open(); }, "numbers");
    }
    flip(numbers, offset);
  }
  std::filesystem::resize_file(numbers, 1999);
  Steps steps(folder / "ck");
  expectError([&] { steps.open(); }, "block 4 of");
}

} // namespace smg::testing
