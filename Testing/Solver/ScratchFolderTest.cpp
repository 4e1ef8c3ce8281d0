// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/ScratchFolder.h"

#include "Solver/Core/SystemCalls.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>

namespace smg::testing
{

TEST(ScratchFolder, IsRemovedWithAllItHolds)
{
  const TemporaryFolder folder;
  {
    const ScratchFolder a(folder.path());
    const ScratchFolder b(folder.path());
    EXPECT_NE(a.path(), b.path());
    EXPECT_EQ(folder.entries(), 2);
    std::filesystem::create_directories(a.path() / "x" / "y");
  }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(ScratchFolder, InAPlaceThatDoesNotExistIsAnErrorThatNamesIt)
{
  const TemporaryFolder folder;
  try
  {
    const ScratchFolder scratch(folder / "nowhere");
    FAIL();
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find((folder / "nowhere").string()), std::string::npos);
  }
}

TEST(ScratchFolder, WithoutATemporaryFolderIsAnErrorThatAsksForAnother)
{
  const char* const before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", "/nowhere", 1);
  const std::string message = messageOf([] { const ScratchFolder scratch({}); });
  before ? ::setenv("TMPDIR", kept.c_str(), 1) : ::unsetenv("TMPDIR");
  EXPECT_NE(message.find("no temporary folder"), std::string::npos) << message;
  EXPECT_NE(message.find("name a scratch folder"), std::string::npos) << message;
}

TEST(ScratchFolder, WhatAKilledProgramLeftIsRemovedByTheNextAndNothingElse)
{
  const TemporaryFolder folder;
  const ScratchFolder living(folder.path());
  std::ofstream(living.path() / "data") << "in use";
  // Other folders, with any names.
  for (const char* name : { "smg-scratch-abcdef", "smg-scratch-", "smg-mesh01" })
  {
    std::filesystem::create_directory(folder / name);
    std::ofstream(folder / name / "data") << "precious";
  }
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0)
  {
    const ScratchFolder abandoned(folder.path());
    std::filesystem::create_directories(abandoned.path() / "x" / "y");
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(folder.entries(), 5);

  const ScratchFolder next(folder.path());
  EXPECT_EQ(folder.entries(), 5) << "the abandoned one has gone, the next one has come";
  EXPECT_TRUE(std::filesystem::exists(living.path() / "data"));
  for (const char* name : { "smg-scratch-abcdef", "smg-scratch-", "smg-mesh01" })
  {
    EXPECT_TRUE(std::filesystem::exists(folder / name / "data")) << name;
  }
}

/** The objects of a forked child are copies: their destructors leave the files to the parent. */
TEST(ScratchFolder, IsLeftToItsParentByAForkedChild)
{
  const TemporaryFolder folder;
  auto scratch = std::make_unique<ScratchFolder>(folder.path());
  auto kept = std::make_unique<ScratchFolder>(KeptFolder(folder / "kept"));
  auto temporary =
    std::make_unique<FileDescriptor>(FileDescriptor::createBeside(folder / "result"));
  std::ofstream(scratch->path() / "data") << "in use";
  kept->file("data");
  const int before = folder.entries();
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0)
  {
    scratch.reset();
    kept.reset();
    temporary.reset();
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(folder.entries(), before);
  EXPECT_TRUE(std::filesystem::exists(scratch->path() / "data"));
  EXPECT_TRUE(std::filesystem::exists(kept->pathOf("data")));
  {
    const ScratchFolder other(folder.path());
    EXPECT_TRUE(std::filesystem::exists(scratch->path())) << "its lock has gone";
  }
  scratch.reset();
  kept.reset();
  temporary.reset();
  EXPECT_EQ(folder.entries(), 0);
}

/** Children outlive their parents: what the parent has locked is free when it ends. */
TEST(ScratchFolder, IsUnlockedByTheEndOfAParentWhoseChildLives)
{
  const TemporaryFolder folder;
  std::array<int, 2> said{}, ending{};
  ASSERT_EQ(pipe(said.data()), 0);
  ASSERT_EQ(pipe(ending.data()), 0);
  const pid_t parent = fork();
  ASSERT_GE(parent, 0);
  if (parent == 0)
  {
    ScratchFolder kept(KeptFolder(folder / "kept"));
    kept.retain();
    if (fork() == 0)
    {
      char end = 0;
      close(ending[1]);
      write(said[1], "c", 1);
      read(ending[0], &end, 1); // until the test has closed its end
      _exit(0);
    }
    pause();
  }
  char word = 0;
  ASSERT_EQ(read(said[0], &word, 1), 1);
  EXPECT_THROW(ScratchFolder(KeptFolder(folder / "kept")), Error);
  kill(parent, SIGKILL);
  ASSERT_EQ(waitpid(parent, nullptr, 0), parent);
  EXPECT_NO_THROW(ScratchFolder(KeptFolder(folder / "kept")));
  for (const int end : { said[0], said[1], ending[0], ending[1] })
  {
    close(end);
  }
}

/** A program may be killed before it marks its folder, and a power cut may take the marker. */
TEST(ScratchFolder, WithoutItsMarkerIsRemovedIfItIsEmptyAndNotInUse)
{
  const TemporaryFolder folder;
  for (const char* name : { "smg-scratch-Ab3dEf", ".smg-scratch-0bcdEf", "smg-scratch-used00" })
  {
    std::filesystem::create_directory(folder / name);
  }
  const int used = ::open((folder / "smg-scratch-used00").c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(used, LOCK_EX), 0);
  // Names of others.
  const auto others = { "smg-scratch-my-mesh", "smg-scratch-a.bcde", ".smg-scratch",
    "smg-scratch-" };
  for (const char* name : others)
  {
    std::filesystem::create_directory(folder / name);
  }
  {
    const ScratchFolder next(folder.path());
    EXPECT_FALSE(std::filesystem::exists(folder / "smg-scratch-Ab3dEf"));
    EXPECT_FALSE(std::filesystem::exists(folder / ".smg-scratch-0bcdEf"));
    EXPECT_TRUE(std::filesystem::exists(folder / "smg-scratch-used00"));
  }
  ::close(used);
  for (const char* name : others)
  {
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
}

/** Two programs begin: one takes the folder of the other for an abandoned one before it is locked.
 */
TEST(ScratchFolder, ThatIsRemovedBeforeItIsLockedIsMadeAnew)
{
  static const SystemCalls real = systemCalls();
  static int made;
  made = 0;
  const TemporaryFolder folder;
  systemCalls().mkdtemp = [](char* pattern)
  {
    char* const path = real.mkdtemp(pattern);
    if (++made == 1)
    {
      ::rmdir(path);
    }
    return path;
  };
  {
    const ScratchFolder scratch(folder.path());
    EXPECT_TRUE(ScratchFolder::isOne(scratch.path()));
    EXPECT_EQ(made, 2);
  }
  systemCalls() = real;
  EXPECT_EQ(folder.entries(), 0);
}

} // namespace smg::testing
