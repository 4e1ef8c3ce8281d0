// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/FileDescriptor.h"

#include "Solver/Core/SystemCalls.h"
#include "Solver/Files/DiskFull.h"
#include "Solver/Files/Folder.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Files/ScratchAccount.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Error.h"

#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <span>
#include <string>
#include <sys/stat.h>
#include <sys/uio.h>
#include <system_error>
#include <unistd.h>
#include <utility>

// All reading and writing of files: transfers at given offsets, which continue after interruptions
// and partial transfers, and results that get their name only when they are complete.
//
// A result is written under a temporary name beside its target, synchronised, renamed, and then the
// folder is synchronised (renameTo). At every moment the name belongs to the old file or to the
// whole new one, also after a kill or a power cut. Files in scratch folders skip the waiting:
// nothing in them outlives the program.
//
// All calls go through the table of SystemCalls.h, so that tests can let each of them fail.

namespace smg
{

namespace
{

/** Refuses folders, pipes and devices, which could be opened: they have no size, or block. */
void requireRegular(int file, const std::filesystem::path& path)
{
  struct stat status = {};
  if (systemCalls().fstat(file, &status) != 0 || !S_ISREG(status.st_mode))
  {
    throw Error(path.string() + ": is not a regular file.");
  }
}

/** O_EXCL: the file must not exist. So no file or link of somebody else is ever written to. */
int openNew(const std::filesystem::path& path)
{
  return systemCalls().open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

/** Transfers all bytes by pread() or pwrite(), also after interruptions and in several parts, and
 * takes from the front of `bytes` what is done. Returns 0, the error number, or `stalled` if the
 * system transfers nothing. */
template <class Call, class Byte>
int transfer(Call call, int file, std::int64_t offset, std::span<Byte>& bytes, int stalled) noexcept
{
  while (!bytes.empty())
  {
    const ssize_t n = call(file, bytes.data(), bytes.size(), offset);
    if (n == 0)
    {
      return stalled;
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

/** The share of a file in the account of `folder`; null if this is not a scratch folder. */
std::shared_ptr<ScratchShare> shareIn(const std::filesystem::path& folder)
{
  std::shared_ptr<ScratchAccount> account = ScratchAccount::of(folder);
  return account ? std::make_shared<ScratchShare>(std::move(account)) : nullptr;
}

} // namespace

FileDescriptor::~FileDescriptor()
{
  this->remove();
}

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept
  : Number(std::exchange(other.Number, -1))
  , Path(std::move(other.Path))
  , Shown(std::move(other.Shown))
  , IsTemporary(std::exchange(other.IsTemporary, false))
  , IsNamed(std::exchange(other.IsNamed, false))
  , Share(std::move(other.Share))
{
}

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept
{
  std::swap(this->Number, other.Number);
  std::swap(this->Path, other.Path);
  std::swap(this->Shown, other.Shown);
  std::swap(this->IsTemporary, other.IsTemporary);
  std::swap(this->IsNamed, other.IsNamed);
  std::swap(this->Share, other.Share);
  return *this;
}

FileDescriptor FileDescriptor::openForReading(const std::filesystem::path& path)
{
  FileDescriptor file;
  file.Path = file.Shown = path;
  // O_NONBLOCK: to open a named pipe without a writer would wait for one, before requireRegular()
  // can refuse it.
  file.Number = systemCalls().open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC, 0);
  if (!file.isOpen())
  {
    throw Error(path.string() + ": cannot be opened: " + systemError(errno) + ".");
  }
  requireRegular(file.Number, path);
  return file;
}

std::filesystem::path FileDescriptor::targetOf(const std::filesystem::path& path)
{
  constexpr int MaxLinks = 40; // the limit of the system
  // The system resolves links when it opens a file, but rename() would replace the link itself.
  // Links that form a circle have no target.
  std::filesystem::path target = path;
  std::error_code none;
  for (int links = 0; std::filesystem::is_symlink(target, none); ++links)
  {
    if (links == MaxLinks)
    {
      throwWriteError(path, ELOOP);
    }
    // The target of a link is relative to the folder of the link; operator/ replaces the whole path
    // if it is absolute.
    target = target.parent_path() / std::filesystem::read_symlink(target, none);
  }
  return target;
}

FileDescriptor FileDescriptor::createBeside(const std::filesystem::path& path)
{
  const std::filesystem::path target = targetOf(path);
  FileDescriptor file;
  file.Shown = path;
  // A program that was killed while it wrote this result has left its temporary file.
  removeAbandonedTemporaries(target);
  // The name is new, but another program may take the file for an abandoned one and remove it
  // before it is locked: then the next name is tried.
  do
  {
    file.close();
    file.Path = temporaryName(target);
    file.Number = openNew(file.Path);
  } while (file.isOpen() ? !lockTemporary(file.Number) : errno == EEXIST);
  if (!file.isOpen())
  {
    throw Error(path.string() + ": cannot be created: " + systemError(errno) + ".");
  }
  file.IsTemporary = true;
  // From here on the destructor removes the file unless it is renamed.
  file.Share = shareIn(target.parent_path());
  return file;
}

FileDescriptor FileDescriptor::createNameless(const std::filesystem::path& folder)
{
  const std::filesystem::path place = folder.empty() ? std::filesystem::path(".") : folder;
  FileDescriptor file;
  file.Path = file.Shown = place / "scratch file";
  file.Share = shareIn(place);
  file.Number = systemCalls().open(place.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (!file.isOpen())
  {
    // Not every file system supports unnamed files (O_TMPFILE). There, a file is created and its
    // name removed at once: it exists until it is closed, also when the program is killed.
    file = createBeside(place / "scratch file");
    systemCalls().unlink(file.Path.c_str());
    file.IsTemporary = false;
  }
  return file;
}

FileDescriptor FileDescriptor::openOrCreate(const std::filesystem::path& path)
{
  FileDescriptor file;
  file.Path = file.Shown = path;
  // O_NOFOLLOW: a link in the folder of a checkpoint, perhaps made by somebody else, must not lead
  // to a file outside of it.
  file.Number =
    systemCalls().open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  if (!file.isOpen())
  {
    throw Error(path.string() + ": cannot be opened: " + systemError(errno) + ".");
  }
  requireRegular(file.Number, path);
  file.IsNamed = true;
  file.Share = shareIn(path.parent_path());
  if (file.Share)
  {
    // The bytes that an earlier program left are in the account of the folder, under the path. They
    // are handed over to the share of this open file.
    ScratchAccount::of(path.parent_path())->remove(path);
    if (!file.Share->extend(file.size()))
    {
      throwWriteError(path, ScratchLimit);
    }
  }
  return file;
}

void FileDescriptor::giveName(const std::filesystem::path& path)
{
  const std::string self = "/proc/self/fd/" + std::to_string(this->Number);
  // linkat() does not replace a file. The link in /proc stands for the unnamed file, which has no
  // other path.
  removeClosed(path);
  if (systemCalls().linkat(AT_FDCWD, self.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) != 0)
  {
    throw Error(path.string() + ": an unnamed file cannot get this name: " + systemError(errno) +
                ": name a folder in another file system.");
  }
  this->Path = this->Shown = path;
  this->IsNamed = true;
}

std::int64_t FileDescriptor::size() const
{
  struct stat status = {};
  if (systemCalls().fstat(this->Number, &status) != 0)
  {
    throwReadError(this->Shown, errno);
  }
  return status.st_size;
}

std::size_t FileDescriptor::readSome(std::int64_t offset, std::span<std::byte> bytes) const
{
  // A read may return fewer bytes than asked for without being at the end; only 0 means the end.
  std::span<std::byte> rest = bytes;
  const int error = transfer(systemCalls().pread, this->Number, offset, rest, EndOfFile);
  if (error != 0 && error != EndOfFile)
  {
    throwReadError(this->Shown, error);
  }
  return bytes.size() - rest.size();
}

int FileDescriptor::tryRead(std::int64_t offset, std::span<std::byte> bytes) const noexcept
{
  // The callers know the size of what they read: an early end is an error of its own kind.
  return transfer(systemCalls().pread, this->Number, offset, bytes, EndOfFile);
}

/** With RWF_NOWAIT the system returns what it has in memory and does not touch the disk. */
std::size_t FileDescriptor::readCached(
  std::int64_t offset, std::span<std::byte> bytes) const noexcept
{
  iovec part{ bytes.data(), bytes.size() };
  const ssize_t n = systemCalls().preadv2(this->Number, &part, 1, offset, RWF_NOWAIT);
  // Not every file system supports it. Then nothing counts as cached, and all of the read as
  // waiting.
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
  // Only the rest, which comes from the disk, counts as waiting.
  const WaitClock clock;
  const int error =
    this->tryRead(offset + static_cast<std::int64_t>(cached), bytes.subspan(cached));
  waited += clock.nanoseconds();
  return error;
}

int FileDescriptor::tryWrite(std::int64_t offset, std::span<const std::byte> bytes) const noexcept
{
  // The limit of scratch files is asked before the file grows, so that it is never exceeded.
  if (this->Share && !this->Share->extend(offset + static_cast<std::int64_t>(bytes.size())))
  {
    return ScratchLimit;
  }
  // EIO: the system takes no byte and names no reason; to try again might never end.
  return transfer(systemCalls().pwrite, this->Number, offset, bytes, EIO);
}

void FileDescriptor::read(std::int64_t offset, std::span<std::byte> bytes) const
{
  if (const int error = this->tryRead(offset, bytes); error != 0)
  {
    throwReadError(this->Shown, error);
  }
}

void FileDescriptor::write(std::int64_t offset, std::span<const std::byte> bytes) const
{
  if (const int error = this->tryWrite(offset, bytes); error != 0)
  {
    throwWriteError(this->Shown, error);
  }
}

void FileDescriptor::reserve(std::int64_t size) const
{
  // FALLOC_FL_KEEP_SIZE: the room is taken, but the file does not grow, so that a file that is not
  // written to its end does not end in zeros.
  while (size > 0 && systemCalls().fallocate(this->Number, FALLOC_FL_KEEP_SIZE, 0, size) != 0)
  {
    // Without the reservation a full disk is noticed when it is full.
    if (errno == EOPNOTSUPP || errno == ENOSYS || errno == EINVAL)
    {
      return;
    }
    if (errno != EINTR)
    {
      throwWriteError(this->Shown, errno);
    }
  }
}

void FileDescriptor::willRead(std::int64_t offset, std::size_t bytes) const noexcept
{
  ::posix_fadvise(this->Number, offset, static_cast<off_t>(bytes), POSIX_FADV_WILLNEED);
}

void FileDescriptor::close()
{
  // After EINTR the descriptor is closed on Linux; to close it once more could hit another file.
  if (this->isOpen() && systemCalls().close(std::exchange(this->Number, -1)) != 0 && errno != EINTR)
  {
    throwWriteError(this->Shown, errno);
  }
  // A temporary file is on the disk, and is counted, until it is renamed or removed.
  if (!this->IsTemporary)
  {
    this->releaseShare();
  }
}

/** Stops counting the file. The bytes of one that stays under its name are handed to the
 * account. */
void FileDescriptor::releaseShare() noexcept
{
  if (this->Share && this->IsNamed)
  {
    this->Share->keep(this->Path);
  }
  this->Share.reset();
}

void FileDescriptor::remove() noexcept
{
  if (this->isOpen())
  {
    systemCalls().close(std::exchange(this->Number, -1));
  }
  // Called by destructors, also while an exception is on its way: failures are ignored here, and
  // the next program that writes the same result removes what is left.
  if (std::exchange(this->IsTemporary, false) && isOwnTemporary(this->Path))
  {
    systemCalls().unlink(this->Path.c_str());
  }
  this->releaseShare();
}

void FileDescriptor::removeClosed(const std::filesystem::path& path) noexcept
{
  systemCalls().unlink(path.c_str());
  if (const std::shared_ptr<ScratchAccount> account = ScratchAccount::of(path.parent_path()))
  {
    account->remove(path);
  }
}

void FileDescriptor::throwWriteError(const std::filesystem::path& path, int errorNumber)
{
  if (errorNumber == ScratchLimit)
  {
    // The message names both figures and the folder that the user has chosen, not the one made in
    // it.
    const std::shared_ptr<ScratchAccount> account = ScratchAccount::of(path.parent_path());
    throw Error(ScratchFolder::placeOf(path.parent_path()).string() + ": " +
                (account ? *account : ScratchAccount::process()).refusal() + '.');
  }
  const std::string sentence =
    path.string() + ": cannot be written: " + systemError(errorNumber) + ".";
  if (errorNumber == ENOSPC || errorNumber == EDQUOT)
  {
    throw DiskFull(sentence);
  }
  throw Error(sentence);
}

void FileDescriptor::throwReadError(const std::filesystem::path& path, int errorNumber)
{
  throw Error(
    path.string() + ": cannot be read: " +
    (errorNumber == EndOfFile ? "it is shorter than expected" : systemError(errorNumber)) + ".");
}

// What makes files and their names durable: fsync() of the file before the renaming, since the
// rename might otherwise reach the disk before the content, and fsync() of the folder after it,
// since the name is content of the folder.

namespace
{

/** For all threads of the process; --no-sync clears it. */
std::atomic<bool> durable{ true };

/** fsync(), continued after interruptions. Some file systems have none, which is not an error:
 * there is nothing to wait for. */
bool sync(int file) noexcept
{
  int result = 0;
  do
  {
    result = systemCalls().fsync(file);
  } while (result != 0 && errno == EINTR);
  return result == 0 || errno == EINVAL || errno == ENOTSUP;
}

/**
 * Keeps the lock of a temporary file until it is renamed, although the file has to be closed
 * before, as only close() reports some failed writes. A lock belongs to the open file, which a
 * second descriptor of it keeps open. Without the lock, another program would remove the file as
 * abandoned.
 */
class LockedUntilRenamed
{
public:
  explicit LockedUntilRenamed(int file)
    : Copy(::fcntl(file, F_DUPFD_CLOEXEC, 0))
  {
  }
  ~LockedUntilRenamed()
  {
    if (this->Copy >= 0)
    {
      systemCalls().close(this->Copy);
    }
  }
  LockedUntilRenamed(const LockedUntilRenamed&) = delete;
  LockedUntilRenamed& operator=(const LockedUntilRenamed&) = delete;

private:
  int Copy;
};

} // namespace

void FileDescriptor::renameTo(const std::filesystem::path& path)
{
  const std::filesystem::path target = targetOf(path);
  const bool isKept = !ScratchFolder::isOne(target.parent_path());
  // In a scratch folder nothing needs to survive: no waiting for the disk.
  if (isKept)
  {
    this->sync();
  }
  const LockedUntilRenamed lock(this->Number);
  this->close();
  if (systemCalls().rename(this->Path.c_str(), target.c_str()) != 0)
  {
    throwWriteError(path, errno);
  }
  // If the rename fails the file is still temporary, and its destructor removes it.
  this->IsTemporary = false;
  // A file in a scratch folder counts under its new name until it is removed.
  if (this->Share)
  {
    this->Share->keep(target);
  }
  if (isKept)
  {
    syncPath(target.parent_path(), path);
  }
}

void FileDescriptor::setDurable(bool isDurable) noexcept
{
  durable = isDurable;
}

void FileDescriptor::sync() const
{
  if (!trySync(this->Number))
  {
    throwWriteError(this->Shown, errno);
  }
}

bool FileDescriptor::trySync(int file) noexcept
{
  return !durable || smg::sync(file);
}

void FileDescriptor::syncPath(const std::filesystem::path& path, const std::filesystem::path& shown)
{
  const std::filesystem::path place = path.empty() ? std::filesystem::path(".") : path;
  const int file = systemCalls().open(place.c_str(), O_RDONLY | O_CLOEXEC, 0);
  // There are folders in which one may write, but not read: these cannot be opened to synchronise
  // them.
  const bool good = file >= 0 ? trySync(file) : errno == EACCES;
  const int error = errno;
  if (file >= 0)
  {
    systemCalls().close(file);
  }
  if (!good)
  {
    throw Error(shown.string() +
                ": is written, but may be lost in a power cut, since its folder cannot be: " +
                systemError(error) + '.');
  }
}

void writeFile(const std::filesystem::path& path, std::string_view text)
{
  // If anything fails before the rename, the destructor removes the temporary file, and an existing
  // file of this name is as it was.
  FileDescriptor file = FileDescriptor::createBeside(path);
  file.write(0, std::as_bytes(std::span(text)));
  file.renameTo(path);
}

void moveFile(const std::filesystem::path& from, const std::filesystem::path& to)
{
  if (systemCalls().rename(from.c_str(), to.c_str()) != 0)
  {
    FileDescriptor::throwWriteError(to, errno);
  }
}

} // namespace smg
