// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Storage/FileDescriptor.h"

#include "Solver/Storage/WaitClock.h"
#include "smg/Error.h"

#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <sys/uio.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace smg
{

namespace
{

std::string reason(int errorNumber)
{
  return std::generic_category().message(errorNumber);
}

/** A unique name, unless a terminated process left a file with it. */
std::filesystem::path temporaryName(const std::filesystem::path& path)
{
  static std::atomic<unsigned> count{ 0 };
  return path.string() + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(count++);
}

int openNew(const std::filesystem::path& path)
{
  return ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

} // namespace

FileDescriptor::~FileDescriptor()
{
  if (this->isOpen())
  {
    ::close(this->Number);
  }
}

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept
  : Number(std::exchange(other.Number, -1))
  , Path(std::move(other.Path))
{
}

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept
{
  std::swap(this->Number, other.Number);
  std::swap(this->Path, other.Path);
  return *this;
}

FileDescriptor FileDescriptor::openForReading(const std::filesystem::path& path)
{
  FileDescriptor file;
  file.Path = path;
  file.Number = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (!file.isOpen())
  {
    throw Error(path.string() + ": cannot be opened: " + reason(errno) + ".");
  }
  struct stat status = {};
  if (::fstat(file.Number, &status) != 0 || !S_ISREG(status.st_mode))
  {
    throw Error(path.string() + ": is not a regular file.");
  }
  return file;
}

std::filesystem::path FileDescriptor::targetOf(const std::filesystem::path& path)
{
  constexpr int MostLinks = 40; // the limit of the system
  std::filesystem::path target = path;
  std::error_code none;
  for (int links = 0; std::filesystem::is_symlink(target, none); ++links)
  {
    if (links == MostLinks)
    {
      throwWriteError(path, ELOOP);
    }
    // A link to an absolute path replaces the whole path.
    target = target.parent_path() / std::filesystem::read_symlink(target, none);
  }
  return target;
}

FileDescriptor FileDescriptor::createBeside(const std::filesystem::path& path)
{
  const std::filesystem::path target = targetOf(path);
  FileDescriptor file;
  do
  {
    file.Path = temporaryName(target);
    file.Number = openNew(file.Path);
  } while (!file.isOpen() && errno == EEXIST);
  if (!file.isOpen())
  {
    throw Error(path.string() + ": cannot be created: " + reason(errno) + ".");
  }
  return file;
}

FileDescriptor FileDescriptor::createNameless(const std::filesystem::path& folder)
{
  const std::filesystem::path place = folder.empty() ? std::filesystem::path(".") : folder;
  FileDescriptor file;
  file.Path = place / "scratch file";
  file.Number = ::open(place.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (!file.isOpen())
  {
    // Not every file system supports unnamed files.
    file = createBeside(place / "smg-scratch");
    ::unlink(file.Path.c_str());
  }
  return file;
}

std::int64_t FileDescriptor::size() const
{
  struct stat status = {};
  if (::fstat(this->Number, &status) != 0)
  {
    throwReadError(this->Path, errno);
  }
  return status.st_size;
}

std::size_t FileDescriptor::readSome(std::int64_t offset, std::span<std::byte> bytes) const
{
  std::size_t done = 0;
  while (done < bytes.size())
  {
    const ssize_t n =
      ::pread(this->Number, bytes.data() + done, bytes.size() - done, offset + std::int64_t(done));
    if (n == 0)
    {
      break;
    }
    if (n > 0)
    {
      done += n;
    }
    else if (errno != EINTR)
    {
      throwReadError(this->Path, errno);
    }
  }
  return done;
}

int FileDescriptor::tryRead(std::int64_t offset, std::span<std::byte> bytes) const noexcept
{
  while (!bytes.empty())
  {
    const ssize_t n = ::pread(this->Number, bytes.data(), bytes.size(), offset);
    if (n == 0)
    {
      return -1;
    }
    if (n > 0)
    {
      bytes = bytes.subspan(n);
      offset += n;
    }
    else if (errno != EINTR)
    {
      return errno;
    }
  }
  return 0;
}

std::size_t FileDescriptor::readCached(
  std::int64_t offset, std::span<std::byte> bytes) const noexcept
{
  iovec part{ bytes.data(), bytes.size() };
  const ssize_t n = ::preadv2(this->Number, &part, 1, offset, RWF_NOWAIT);
  // Not every file system supports this: then nothing counts as cached.
  return n > 0 ? static_cast<std::size_t>(n) : 0;
}

int FileDescriptor::tryRead(
  std::int64_t offset, std::span<std::byte> bytes, std::int64_t& waited) const noexcept
{
  const std::size_t cached = bytes.empty() ? 0 : this->readCached(offset, bytes);
  if (cached == bytes.size())
  {
    return 0;
  }
  const WaitClock clock;
  const int error =
    this->tryRead(offset + static_cast<std::int64_t>(cached), bytes.subspan(cached));
  waited += clock.nanoseconds();
  return error;
}

int FileDescriptor::tryWrite(std::int64_t offset, std::span<const std::byte> bytes) const noexcept
{
  while (!bytes.empty())
  {
    const ssize_t n = ::pwrite(this->Number, bytes.data(), bytes.size(), offset);
    if (n >= 0)
    {
      bytes = bytes.subspan(n);
      offset += n;
    }
    else if (errno != EINTR)
    {
      return errno;
    }
  }
  return 0;
}

void FileDescriptor::read(std::int64_t offset, std::span<std::byte> bytes) const
{
  if (const int error = this->tryRead(offset, bytes); error != 0)
  {
    throwReadError(this->Path, error);
  }
}

void FileDescriptor::write(std::int64_t offset, std::span<const std::byte> bytes) const
{
  if (const int error = this->tryWrite(offset, bytes); error != 0)
  {
    throwWriteError(this->Path, error);
  }
}

void FileDescriptor::willRead(std::int64_t offset, std::size_t bytes) const noexcept
{
  ::posix_fadvise(this->Number, offset, static_cast<off_t>(bytes), POSIX_FADV_WILLNEED);
}

void FileDescriptor::close()
{
  if (this->isOpen() && ::close(std::exchange(this->Number, -1)) != 0 && errno != EINTR)
  {
    throwWriteError(this->Path, errno);
  }
}

void FileDescriptor::renameTo(const std::filesystem::path& path)
{
  try
  {
    this->close();
  }
  catch (...)
  {
    this->remove();
    throw;
  }
  const std::filesystem::path target = targetOf(path);
  if (::rename(this->Path.c_str(), target.c_str()) != 0)
  {
    const int error = errno;
    this->remove();
    throwWriteError(path, error);
  }
  this->Path = target;
}

void FileDescriptor::remove() noexcept
{
  if (this->isOpen())
  {
    ::close(std::exchange(this->Number, -1));
  }
  ::unlink(this->Path.c_str());
}

void FileDescriptor::throwWriteError(const std::filesystem::path& path, int errorNumber)
{
  throw Error(path.string() + ": cannot be written: " + reason(errorNumber) + ".");
}

void FileDescriptor::throwReadError(const std::filesystem::path& path, int errorNumber)
{
  throw Error(path.string() + ": cannot be read: " +
              (errorNumber < 0 ? "it is shorter than expected" : reason(errorNumber)) + ".");
}

} // namespace smg
