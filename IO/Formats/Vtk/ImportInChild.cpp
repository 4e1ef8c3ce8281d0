// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/ImportInChild.h"

#include "Solver/Core/Error.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
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

/** Writes all of a text; if nobody reads it any more there is nobody to tell. */
void send(int pipe, std::string_view text)
{
  while (!text.empty())
  {
    const ssize_t written = ::write(pipe, text.data(), text.size());
    if (written < 0 && errno != EINTR)
    {
      return;
    }
    text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
}

/**
 * What the child does; it never returns to the code that started it. It says nothing, or else the
 * sentence of an error.
 */
[[noreturn]] void runChild(int pipe, const VtkRecoder& recode, const std::filesystem::path& from,
  const std::filesystem::path& to, std::int64_t memory)
{
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGPIPE, SIG_DFL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, secondsFor(from));
  // Not the address space: of that, every thread may reserve a lot without using it.
  limit(RLIMIT_DATA, static_cast<std::uintmax_t>(memory + SpareBytes + dataBytes()));
  // What libraries print when they fail is not for the user: the parent says what happened.
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  try
  {
    recode(from, to);
  }
  catch (const std::bad_alloc&)
  {
    send(pipe, from.string() + ": reading it takes more memory than is allowed: it is damaged, or "
                               "the memory limit is too low.");
  }
  catch (const std::exception& error)
  {
    send(pipe, error.what());
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

/** Milliseconds of silence after which the parent looks whether to go on. */
constexpr int Patience = 50;

/** All that the child sends up to its end. */
std::string receive(int pipe, const ProgressFunction& progress)
{
  std::string text;
  for (;;)
  {
    if (progress && !progress(0.0))
    {
      throw Cancelled();
    }
    pollfd wanted{ pipe, POLLIN, 0 };
    if (::poll(&wanted, 1, Patience) <= 0)
    {
      continue;
    }
    char part[1024];
    const ssize_t got = ::read(pipe, part, sizeof(part));
    if (got == 0 || (got < 0 && errno != EINTR))
    {
      return text;
    }
    text.append(part, static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  }
}

void recodeInChild(const VtkRecoder& recode, const std::filesystem::path& from,
  const std::filesystem::path& to, std::int64_t memory, const ProgressFunction& progress)
{
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
  {
    throw Error(from.string() + ": no pipe can be made to read it: " + std::strerror(errno) + '.');
  }
  PipeEnd in(ends[0]);
  PipeEnd out(ends[1]);
  const pid_t id = ::fork();
  if (id < 0)
  {
    throw Error(
      from.string() + ": no process can be started to read it: " + std::strerror(errno) + '.');
  }
  if (id == 0)
  {
    in.close();
    runChild(out.number(), recode, from, to, memory);
  }
  Child child(id);
  out.close();
  const std::string complaint = receive(in.number(), progress);
  const int status = child.wait();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
  {
    failAfter(status, from);
  }
  if (!complaint.empty())
  {
    throw Error(complaint);
  }
}

} // namespace

void importInChild(const VtkRecoder& recode, const std::filesystem::path& path, VtkXmlKind kind,
  RawMeshBuilder& builder, const ProgressFunction& progress)
{
  const std::int64_t memory = builder.workspace().available();
  importRecoded([&](const std::filesystem::path& from, const std::filesystem::path& to)
    { recodeInChild(recode, from, to, memory, progress); },
    path, kind, builder, progress);
}

} // namespace smg
