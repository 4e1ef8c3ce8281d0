// SPDX-License-Identifier: BSD-3-Clause
// A library that is loaded before a program (LD_PRELOAD) and makes its calls to the system, or its
// allocations by operator new, fail as the environment says:
//   SMG_FAULT         "CALL NTH once|forever WHAT" (see Fault::parse()); the call `new` throws
//                     std::bad_alloc, and is counted from the first call to the system on, when the
//                     arguments are parsed
//   SMG_FAULT_SPARED  paths of files whose bits are never wrong (see spare())
//   SMG_FAULT_COUNT   a file that gets the number of counted calls when the program ends
//   SMG_FAULT_SERVER  instead of SMG_FAULT: a file for the output of the program, which runs once
//   for
//                     each fault that is read from the standard input (see serve())
#include "Testing/Faults/Fault.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace
{

/** Smaller allocations are not counted: some constructors of nlohmann::json, declared noexcept,
 * end the program where one of those for a report fails. */
constexpr std::size_t MinCounted = 4096;

std::atomic<std::int64_t> allocations{ 0 };
std::int64_t failing = 0; // from 1; 0: none
bool failsForever = false;
bool countsNew = false;

/**
 * Returns a fault from the standard input in a new process for each, which continues as the program
 * would; writes its exit status to the standard output, negative for a signal. Thus the libraries
 * are loaded and initialized once, which takes longer than most runs.
 */
std::string serve(const char* output)
{
  for (char line[256]; std::fgets(line, sizeof line, stdin);)
  {
    const pid_t child = ::fork();
    if (child == 0)
    {
      const bool isOpen = std::freopen("/dev/null", "r", stdin) &&
                          std::freopen(output, "w", stdout) &&
                          ::dup2(STDOUT_FILENO, STDERR_FILENO) >= 0;
      return isOpen ? line : std::string();
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    std::printf("%d\n", WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status));
    std::fflush(stdout);
  }
  ::_exit(0);
}

/** Installed after the libraries are initialized, and removed before their files are closed. */
class Installed
{
public:
  Installed()
  {
    const char* const server = std::getenv("SMG_FAULT_SERVER");
    const char* const only = std::getenv("SMG_FAULT");
    if (const std::string text = server ? serve(server) : only ? only : ""; !text.empty())
    {
      const auto fault = smg::testing::Fault::parse(text);
      countsNew = fault.call == "new";
      if (countsNew)
      {
        failsForever = fault.forever;
        allocations = 0;
        failing = fault.nth;
        smg::testing::install({}); // counts
        return;
      }
      if (const char* paths = std::getenv("SMG_FAULT_SPARED"))
      {
        smg::testing::spare(paths);
      }
      smg::testing::install(fault);
    }
  }
  ~Installed()
  {
    failing = 0;
    if (const char* name = std::getenv("SMG_FAULT_COUNT"))
    {
      if (std::FILE* file = std::fopen(name, "w"))
      {
        std::fprintf(file, "%lld\n",
          static_cast<long long>(countsNew ? allocations.load() : smg::testing::countedCalls()));
        std::fclose(file);
      }
    }
  }
};

const Installed installed;

void* allocate(std::size_t bytes, std::size_t alignment)
{
  const bool counts = bytes >= MinCounted && smg::testing::countedCalls() > 0;
  const std::int64_t number = counts ? ++allocations : 0;
  if (number > 0 && failing > 0 && (failsForever ? number >= failing : number == failing))
  {
    throw std::bad_alloc();
  }
  void* const memory =
    alignment == 0 ? std::malloc(bytes > 0 ? bytes : 1)
                   : std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

} // namespace

void* operator new(std::size_t bytes)
{
  return allocate(bytes, 0);
}
void* operator new(std::size_t bytes, std::align_val_t alignment)
{
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t bytes, const std::nothrow_t& /*nothrow*/) noexcept
{
  return std::malloc(bytes > 0 ? bytes : 1);
}
void operator delete(void* memory) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t /*bytes*/) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept
{
  std::free(memory);
}
