// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/ChildProcess.h"

#include "Testing/Benchmarks/Usage.h"
#include "smg/Error.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

namespace smg::benchmark
{
namespace
{

void writeAll(int file, const std::string& text)
{
  for (std::size_t done = 0; done < text.size();)
  {
    const ssize_t written = write(file, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR)
    {
      return;
    }
    done += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
}

std::string readAll(int file)
{
  std::string text;
  std::array<char, 4096> buffer;
  for (;;)
  {
    const ssize_t got = read(file, buffer.data(), buffer.size());
    if (got > 0)
    {
      text.append(buffer.data(), static_cast<std::size_t>(got));
    }
    else if (got == 0 || errno != EINTR)
    {
      return text;
    }
  }
}

nlohmann::json answerOf(const std::function<nlohmann::json()>& work)
{
  try
  {
    resetPeak();
    return work();
  }
  catch (const std::exception& error)
  {
    return { { "failed", error.what() } };
  }
}

} // namespace

nlohmann::json runInChild(const std::function<nlohmann::json()>& work)
{
  std::array<int, 2> ends;
  if (pipe(ends.data()) != 0)
  {
    throw Error(std::string("No pipe can be made: ") + std::strerror(errno) + ".");
  }
  const pid_t child = fork();
  if (child < 0)
  {
    throw Error(std::string("No process can be made: ") + std::strerror(errno) + ".");
  }
  if (child == 0)
  {
    close(ends[0]);
    writeAll(ends[1], answerOf(work).dump());
    // Skips the clean-up of the parent.
    _exit(0);
  }
  close(ends[1]);
  const std::string text = readAll(ends[0]);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status))
  {
    return { { "failed", std::string("killed: ") + strsignal(WTERMSIG(status)) } };
  }
  const nlohmann::json answer = nlohmann::json::parse(text, nullptr, false);
  return answer.is_discarded() ? nlohmann::json{ { "failed", "no answer" } } : answer;
}

} // namespace smg::benchmark
