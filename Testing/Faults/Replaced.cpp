// SPDX-License-Identifier: BSD-3-Clause
// A library that is loaded before a program (LD_PRELOAD) and replaces a file while the program uses
// it, as programs do that install a file under its name:
//   SMG_REPLACED       the file
//   SMG_REPLACED_BY    a file with the other content
//   SMG_REPLACED_AT    number of the opening, from 1, before which it is replaced; "every": before
//                      every opening, by both contents in turn
//   SMG_REPLACED_HOW   rename: another file gets its name; write: its content is overwritten
//   SMG_REPLACED_COUNT a file that gets the number of openings when the program ends
#include "Solver/Core/SystemCalls.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

namespace smg::testing
{
namespace
{

const SystemCalls real = systemCalls();

std::string text(const char* name)
{
  const char* const value = std::getenv(name);
  return value ? value : "";
}

const std::string Path = text("SMG_REPLACED"), Other = text("SMG_REPLACED_BY"),
                  At = text("SMG_REPLACED_AT"), How = text("SMG_REPLACED_HOW");
std::atomic<int> openings{ 0 };

std::string contentOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

void put(const std::string& content, const std::string& path)
{
  std::ofstream(path, std::ios::binary) << content;
}

void replace(int opening)
{
  static const std::string contents[2] = { contentOf(Path), contentOf(Other) };
  const std::string& next = contents[opening % 2 == 1 || At != "every" ? 1 : 0];
  // A time of change has the resolution of the clock's tick.
  ::usleep(10000);
  if (How == "write")
  {
    put(next, Path);
    return;
  }
  // The old file remains under another name, so that no new one gets its number.
  const std::string tag = std::to_string(opening);
  ::link(Path.c_str(), (Path + ".old" + tag).c_str());
  put(next, Path + ".new");
  ::rename((Path + ".new").c_str(), Path.c_str());
}

bool isReplaced(const char* path)
{
  std::error_code absent;
  return !Path.empty() && std::filesystem::equivalent(path, Path, absent);
}

int openReplaced(const char* path, int flags, mode_t mode)
{
  if (isReplaced(path))
  {
    const int opening = ++openings;
    if (At == "every" || At == std::to_string(opening))
    {
      replace(opening);
    }
  }
  return real.open(path, flags, mode);
}

class Installed
{
public:
  Installed() { systemCalls().open = openReplaced; }
  ~Installed()
  {
    systemCalls().open = real.open;
    if (const std::string name = text("SMG_REPLACED_COUNT"); !name.empty())
    {
      put(std::to_string(openings), name);
    }
  }
};

const Installed installed;

} // namespace
} // namespace smg::testing
