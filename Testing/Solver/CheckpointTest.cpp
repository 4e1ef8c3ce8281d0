// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Checkpoint/Checkpoint.h"
#include "Solver/Core/SystemCalls.h"
#include "Solver/Files/Folder.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Files/ScratchStream.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <memory>
#include <set>
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
  for (const char* name : { "state.1", "scratch.numbers", "scratch.mesh.vsm" })
  {
    const std::filesystem::path link = kept / name;
    std::filesystem::remove(link);
    std::filesystem::create_symlink(folder / "mine", link);
    expectError([&] { Steps steps(kept); }, "is not a regular file");
    std::filesystem::remove(link);
    std::filesystem::create_hard_link(folder / "mine", link);
    expectError([&] { Steps steps(kept); }, "is not a regular file");
    std::filesystem::remove(link);
  }
  EXPECT_EQ(std::filesystem::file_size(folder / "mine"), 4U);
}

TEST(Checkpoint, LeavesFilesAloneThatAreNotItsOwn)
{
  const TemporaryFolder folder;
  const std::filesystem::path kept = folder / "ck";
  {
    Steps steps(kept);
    steps.open();
    steps.step();
  }
  std::ofstream(kept / "notes") << "text";
  std::filesystem::create_symlink(kept / "notes", kept / "link");
  {
    Steps steps(kept / ""); // a slash at its end
    EXPECT_EQ(steps.open(), 1);
    steps.discard();
  }
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kept))
  {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names, (std::set<std::string>{ "notes", "link" }));
}

/** A program that is killed meanwhile, or a power cut, leaves no state of files that are gone, and
 * no files without the marker. */
TEST(Checkpoint, RemovesStatesBeforeTheirFiles)
{
  static std::vector<std::string> removed;
  static const SystemCalls real = systemCalls();
  removed.clear();
  const TemporaryFolder folder;
  {
    ScratchFolder kept{ KeptFolder(folder / "ck") };
    for (const char* name : { "a", "b", "c", "d" })
    {
      std::ofstream(kept.pathOf(name)) << "file";
      std::ofstream(kept.path() / (std::string("state-") + name + ".0")) << "state";
    }
    systemCalls().unlinkat = [](int at, const char* name, int flags)
    {
      removed.emplace_back(name);
      return real.unlinkat(at, name, flags);
    };
    systemCalls().fsync = [](int file)
    {
      removed.emplace_back("(sync)");
      return real.fsync(file);
    };
    FileDescriptor::setDurable(true);
    kept.discard();
  }
  systemCalls() = real;
  FileDescriptor::setDurable(false);
  ASSERT_GE(removed.size(), 11U);
  for (std::size_t k = 0; k < 4; ++k)
  {
    EXPECT_TRUE(removed[k].starts_with("state-")) << removed[k];
    EXPECT_TRUE(removed[k + 5].starts_with("scratch.")) << removed[k + 5];
  }
  EXPECT_EQ(removed[4], "(sync)");
  EXPECT_EQ(removed[9], "(sync)");
  EXPECT_EQ(removed[10], "smg-checkpoint");
  EXPECT_FALSE(std::filesystem::exists(folder / "ck"));
}

TEST(Checkpoint, IsHandedOnWithinTheProgramAndUsedByOnePartOfIt)
{
  const TemporaryFolder folder;
  const std::filesystem::path kept = folder / "ck";
  std::shared_ptr<FolderLock> lock;
  {
    ScratchFolder first{ KeptFolder(kept) };
    first.retain();
    expectError([&] { ScratchFolder{ KeptFolder(kept) }; }, "is using this checkpoint");
    lock = first.lock();
  }
  const int other = ::open(kept.c_str(), O_RDONLY | O_DIRECTORY);
  EXPECT_NE(::flock(other, LOCK_EX | LOCK_NB), 0) << "it is handed on";
  ScratchFolder second{ KeptFolder(kept) };
  lock.reset();
  EXPECT_NE(::flock(other, LOCK_EX | LOCK_NB), 0) << "the second part has it";
  second.discard();
  ::close(other);
}

TEST(Checkpoint, OfAnotherKindIsRefusedAsThat)
{
  const TemporaryFolder folder;
  {
    Steps steps(folder / "ck");
    steps.open();
    steps.step();
  }
  ScratchFolder opened{ KeptFolder(folder / "ck") };
  Checkpoint others(opened, { { "something else", "a" } });
  Pool memory(1 << 20);
  expectError([&] { others.open(memory); }, "another kind of computation");
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
  const std::filesystem::path numbers = folder / "ck" / "scratch.numbers";
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
