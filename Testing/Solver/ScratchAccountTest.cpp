// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/ScratchAccount.h"

#include "Solver/Files/FileDescriptor.h"
#include "Solver/Files/ScratchFolder.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

const std::vector<std::byte> Kilobyte(1000);

} // namespace

TEST(ScratchAccount, CountsTheBytesOfFilesThatExist)
{
  const TemporaryFolder place;
  const std::int64_t before = ScratchAccount::process().used();
  const ScratchFolder folder(place.path());
  const ScratchAccount& account = folder.account();
  {
    FileDescriptor nameless = FileDescriptor::createNameless(folder.path());
    nameless.write(0, Kilobyte);
    nameless.write(500, Kilobyte); // 500 bytes more
    FileDescriptor other;
    other = std::move(nameless);
    other.write(0, Kilobyte);
    EXPECT_EQ(account.used(), 1500);
    EXPECT_EQ(ScratchAccount::process().used(), before + 1500);
  }
  EXPECT_EQ(account.used(), 0);
  {
    const FileDescriptor abandoned = FileDescriptor::createBeside(folder / "named");
    abandoned.write(0, Kilobyte);
    EXPECT_EQ(account.used(), 1000);
  }
  EXPECT_EQ(account.used(), 0);
  EXPECT_EQ(account.peak(), 1500);
}

TEST(ScratchAccount, CountsNamedFilesUntilTheyAreRemoved)
{
  const TemporaryFolder place;
  const std::int64_t before = ScratchAccount::process().used();
  {
    const ScratchFolder folder(place.path());
    for (const char* name : { "a", "b", "a" })
    {
      FileDescriptor file = FileDescriptor::createBeside(folder / name);
      file.write(0, Kilobyte);
      file.renameTo(folder / name);
    }
    EXPECT_EQ(folder.account().used(), 2000) << "one file replaced another one";
    EXPECT_EQ(folder.account().peak(), 3000);
    FileDescriptor::removeClosed(folder / "a");
    FileDescriptor::removeClosed(folder / "a");
    EXPECT_EQ(folder.account().used(), 1000);
  }
  EXPECT_EQ(ScratchAccount::process().used(), before);
}

TEST(ScratchAccount, NamelessFilesOutliveTheirFolder)
{
  const TemporaryFolder place;
  const std::int64_t before = ScratchAccount::process().used();
  std::optional<ScratchFolder> folder(std::in_place, place.path(), 1500);
  std::optional<FileDescriptor> file(FileDescriptor::createNameless(folder->path()));
  folder.reset();
  file->write(0, Kilobyte);
  EXPECT_EQ(ScratchAccount::process().used(), before + 1000);
  EXPECT_EQ(file->tryWrite(1000, Kilobyte), FileDescriptor::ScratchLimit);
  file.reset();
  EXPECT_EQ(ScratchAccount::process().used(), before);
}

TEST(ScratchAccount, AFolderInAnotherOneSharesItsLimit)
{
  const TemporaryFolder place;
  const ScratchFolder outer(place.path(), 2500);
  const ScratchFolder inner(outer.path());
  const FileDescriptor a = FileDescriptor::createNameless(outer.path());
  const FileDescriptor b = FileDescriptor::createNameless(inner.path());
  a.write(0, Kilobyte);
  b.write(0, Kilobyte);
  EXPECT_EQ(messageOf([&] { b.write(1000, Kilobyte); }),
    place.path().string() +
      ": the scratch files would take at least 1 MiB (3000 bytes) but their limit is 1 MiB (2500 "
      "bytes): raise the limit of scratch files (option --scratch-limit, property ScratchLimit).");
  EXPECT_EQ(b.size(), 1000);
  EXPECT_EQ(inner.account().used(), 1000);
  EXPECT_EQ(outer.account().used(), 2000);
}

TEST(ScratchAccount, CountsWhatAnEarlierProgramKept)
{
  const TemporaryFolder place;
  const std::int64_t before = ScratchAccount::process().used();
  {
    ScratchFolder folder(KeptFolder(place / "kept"));
    folder.file("rows").write(0, Kilobyte);
    folder.retain();
  }
  EXPECT_EQ(ScratchAccount::process().used(), before);
  EXPECT_NE(messageOf([&] { const ScratchFolder folder(KeptFolder(place / "kept"), 999); })
              .find("(1000 bytes) but their limit"),
    std::string::npos);
  EXPECT_EQ(ScratchAccount::process().used(), before);
  const ScratchFolder folder(KeptFolder(place / "kept"), 1500);
  const std::int64_t kept = folder.account().used();
  EXPECT_EQ(kept, 1000);
  const FileDescriptor rows = folder.file("rows");
  EXPECT_EQ(folder.account().used(), kept);
  rows.write(500, Kilobyte);
  EXPECT_EQ(folder.account().used(), kept + 500);
  EXPECT_EQ(rows.tryWrite(1000, Kilobyte), FileDescriptor::ScratchLimit);
}

TEST(ScratchAccount, OtherFilesDoNotCount)
{
  const TemporaryFolder place;
  const std::int64_t before = ScratchAccount::process().used();
  const FileDescriptor file = FileDescriptor::createBeside(place / "result");
  file.write(0, Kilobyte);
  EXPECT_EQ(ScratchAccount::process().used(), before);
}

} // namespace smg::testing
