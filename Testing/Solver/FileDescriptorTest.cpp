// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/FileDescriptor.h"

#include "Solver/Core/SystemCalls.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace smg::testing
{
namespace
{

/** Removes a file from the cache of the system. */
void dropFromMemory(const std::filesystem::path& path)
{
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_GE(file, 0);
  EXPECT_EQ(::fsync(file), 0);
  EXPECT_EQ(::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED), 0);
  ::close(file);
}

} // namespace

TEST(FileDescriptor, ReadsWhatIsInMemoryAndWhatIsNot)
{
  const TemporaryFolder folder;
  const FileDescriptor file = FileDescriptor::createBeside(folder / "file");
  const std::vector<std::byte> written(100000, std::byte{ 7 });
  ASSERT_EQ(file.tryWrite(0, written), 0);
  for (const bool dropped : { false, true })
  {
    if (dropped)
    {
      dropFromMemory(file.path());
    }
    std::vector<std::byte> read(written.size());
    std::int64_t waited = 0;
    EXPECT_EQ(file.tryRead(0, read, waited), 0);
    EXPECT_EQ(read, written);
  }
}

TEST(FileDescriptor, SaysThatAFileEndsBefore)
{
  const TemporaryFolder folder;
  const FileDescriptor file = FileDescriptor::createNameless(folder.path());
  ASSERT_EQ(file.tryWrite(0, std::vector<std::byte>(100)), 0);
  std::vector<std::byte> read(101);
  std::int64_t waited = 0;
  EXPECT_EQ(file.tryRead(0, read, waited), -1);
}

TEST(FileDescriptor, WritesThroughLinks)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "elsewhere");
  std::filesystem::create_symlink("elsewhere/second", folder / "link");
  std::filesystem::create_symlink(folder / "elsewhere" / "file", folder / "elsewhere" / "second");
  for (const char* text : { "once", "again" })
  {
    FileDescriptor file = FileDescriptor::createBeside(folder / "link");
    EXPECT_EQ(file.path().parent_path(), folder / "elsewhere");
    file.write(0, std::as_bytes(std::span(text, 4)));
    file.renameTo(folder / "link");
    std::string written;
    std::ifstream(folder / "elsewhere" / "file") >> written;
    EXPECT_EQ(written, std::string(text, 4));
  }
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "elsewhere" / "second"));
  EXPECT_EQ(folder.entries(), 2);

  std::filesystem::create_symlink("circle", folder / "circle");
  EXPECT_NE(messageOf([&] { FileDescriptor::createBeside(folder / "circle"); }), "");
}

TEST(FileDescriptor, ReservesRoomWithoutChangingTheFile)
{
  const TemporaryFolder folder;
  const FileDescriptor file = FileDescriptor::createBeside(folder / "file");
  file.write(0, std::vector<std::byte>(100));
  file.reserve(1 << 20);
  EXPECT_EQ(file.size(), 100);
  struct stat status = {};
  ASSERT_EQ(::stat(file.path().c_str(), &status), 0);
  EXPECT_GE(512 * status.st_blocks, 1 << 20);
}

TEST(FileDescriptor, WithoutRoomFailsBeforeAnythingIsWritten)
{
  const TemporaryFolder folder;
  const FileDescriptor file = FileDescriptor::createBeside(folder / "result");
  const SystemCalls before = systemCalls();
  systemCalls().fallocate = [](int, int, off_t, off_t)
  {
    errno = ENOSPC;
    return -1;
  };
  const std::string sentence = messageOf([&] { file.reserve(1000); });
  systemCalls().fallocate = [](int, int, off_t, off_t)
  {
    errno = EOPNOTSUPP;
    return -1;
  };
  EXPECT_NO_THROW(file.reserve(1000)) << "not every file system can reserve";
  systemCalls() = before;
  EXPECT_TRUE(sentence.starts_with((folder / "result").string())) << sentence;
  EXPECT_NE(sentence.find("free space"), std::string::npos) << sentence;
}

} // namespace smg::testing
