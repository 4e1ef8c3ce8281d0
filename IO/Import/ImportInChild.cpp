// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/ImportInChild.h"

#include "IO/Import/MeshPipe.h"
#include "Solver/Core/Error.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <optional>
#include <string>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace smg
{

namespace
{

/** Reading takes about a second for some tens of megabytes; a loop without end takes this. */
constexpr std::uintmax_t LeastSeconds = 20;
constexpr std::uintmax_t BytesOfSecond = 500000;

/** What the process may allocate beyond what a mesh within the budget takes. */
constexpr std::int64_t SpareBytes = std::int64_t(512) << 20;

void limit(int resource, std::uintmax_t most)
{
  rlimit limits{};
  ::getrlimit(static_cast<__rlimit_resource>(resource), &limits);
  if (limits.rlim_cur == RLIM_INFINITY || limits.rlim_cur > most)
  {
    limits.rlim_cur = most;
    ::setrlimit(static_cast<__rlimit_resource>(resource), &limits);
  }
}

/** Bytes of memory that this process has, as RLIMIT_DATA counts them. */
std::int64_t dataBytes()
{
  // Pages in all, resident, shared, of code, 0, of data.
  std::ifstream stream("/proc/self/statm");
  std::int64_t pages = 0;
  for (int i = 0; i < 6; ++i)
  {
    stream >> pages;
  }
  return pages * ::sysconf(_SC_PAGESIZE);
}

std::uintmax_t secondsFor(const std::filesystem::path& path)
{
  std::error_code ignored;
  return LeastSeconds + std::filesystem::file_size(path, ignored) / BytesOfSecond;
}

/** What the child does; it never returns to the code that started it. */
[[noreturn]] void runChild(int pipe, VtkImporter importer, const std::filesystem::path& path,
  MeshFormat format, const ImportOptions& options)
{
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGPIPE, SIG_DFL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, secondsFor(path));
  // Not the address space: of that, every thread may reserve a lot without using it.
  const std::int64_t needed = options.budget.limit() + SpareBytes + dataBytes();
  limit(RLIMIT_DATA, static_cast<std::uintmax_t>(needed));
  // What libraries print when they fail is not for the user: the parent says what happened.
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);

  MeshPipeWriter writer(pipe);
  try
  {
    ImportOptions own = options;
    own.progress = [&writer](double done)
    {
      writer.sendProgress(done);
      return true;
    };
    writer.sendMesh(importer(path, format, own));
  }
  catch (const std::bad_alloc&)
  {
    writer.sendFailure(
      path.string() +
      ": reading it takes more memory than is allowed: it is damaged, or the memory "
      "limit is too low.");
  }
  catch (const std::exception& error)
  {
    writer.sendFailure(error.what());
  }
  ::_exit(0);
}

/** A running child, which does not outlive this. */
class Child
{
public:
  explicit Child(pid_t id)
    : Id(id)
  {
  }
  ~Child()
  {
    if (this->Id > 0)
    {
      ::kill(this->Id, SIGKILL);
      this->wait();
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /** Waits for its end; answers how it ended. */
  int wait()
  {
    int status = 0;
    while (::waitpid(this->Id, &status, 0) < 0 && errno == EINTR)
    {
    }
    this->Id = -1;
    return status;
  }

private:
  pid_t Id;
};

/** The end of a pipe. */
class PipeEnd
{
public:
  explicit PipeEnd(int number)
    : Number(number)
  {
  }
  ~PipeEnd() { this->close(); }
  PipeEnd(const PipeEnd&) = delete;
  PipeEnd& operator=(const PipeEnd&) = delete;

  int number() const { return this->Number; }
  void close()
  {
    if (this->Number >= 0)
    {
      ::close(this->Number);
      this->Number = -1;
    }
  }

private:
  int Number;
};

[[noreturn]] void failAfter(int status, const std::filesystem::path& path)
{
  const bool signalled = WIFSIGNALED(status);
  const int signal = signalled ? WTERMSIG(status) : 0;
  throw Error(path.string() + ": VTK's reader " +
              (signal == SIGXCPU
                  ? "did not come to an end within " + std::to_string(secondsFor(path)) + " seconds"
                : signalled ? std::string("crashed on the file (") + ::strsignal(signal) + ")"
                            : std::string("gave up on the file")) +
              ": the file is damaged.");
}

/** Takes what the child sends until its mesh has come; none if the child ended before. */
std::optional<IndexedMesh> receive(int pipe, Progress& progress)
{
  double done = 0.0;
  MeshPipeReader reader(pipe, [&] { progress.update(done); });
  MeshMessage message{};
  while (reader.next(message))
  {
    if (message == MeshMessage::Progress && reader.receive(done))
    {
      progress.update(done);
    }
    else if (message == MeshMessage::Failure)
    {
      std::string sentence;
      if (reader.receive(sentence))
      {
        throw Error(sentence);
      }
    }
    else if (message == MeshMessage::Mesh)
    {
      IndexedMesh mesh;
      return reader.receive(mesh) ? std::optional(std::move(mesh)) : std::nullopt;
    }
  }
  return std::nullopt;
}

} // namespace

IndexedMesh importInChild(VtkImporter importer, const std::filesystem::path& path,
  MeshFormat format, const ImportOptions& options)
{
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
  {
    throw Error(path.string() + ": no pipe can be made to read it: " + std::strerror(errno) + '.');
  }
  PipeEnd from(ends[0]);
  PipeEnd to(ends[1]);
  const pid_t id = ::fork();
  if (id < 0)
  {
    throw Error(
      path.string() + ": no process can be started to read it: " + std::strerror(errno) + '.');
  }
  if (id == 0)
  {
    from.close();
    runChild(to.number(), importer, path, format, options);
  }
  Child child(id);
  to.close();
  Progress progress(options.progress);
  std::optional<IndexedMesh> mesh = receive(from.number(), progress);
  const int status = child.wait();
  if (!mesh)
  {
    failAfter(status, path);
  }
  return std::move(*mesh);
}

} // namespace smg
