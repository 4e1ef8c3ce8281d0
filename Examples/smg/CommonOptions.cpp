// SPDX-License-Identifier: BSD-3-Clause
#include "CommonOptions.h"

#include "Solver/Core/Error.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

void CommonOptions::addTo(CLI::App& command)
{
  constexpr std::int64_t MostMemory = std::int64_t(1) << 30;
  command.add_option("--report", this->report, "Write the report to this JSON file")
    ->type_name("FILE");
  command.add_option("--memory", this->memory, "Memory limit in MiB")
    ->check(CLI::Range(std::int64_t(1), MostMemory))
    ->type_name("MiB");
  command.add_option("--threads", this->threads, "Compute threads; 0: one a core")
    ->check(CLI::Range(0, 1024))
    ->type_name("N");
  command.add_option("--scratch", this->scratch, "Folder for scratch files")
    ->check(CLI::ExistingDirectory)
    ->type_name("DIR");
  command.add_flag("--quiet", this->quiet, "No progress bar and no summary");
}

void CommonOptions::writeReport(const std::string& json) const
{
  if (this->report.empty())
  {
    return;
  }
  // Written beside it and renamed, so that a reader never sees half a report.
  const std::filesystem::path part = this->report.string() + ".part";
  std::ofstream stream(part);
  stream << json << '\n';
  stream.close();
  if (!stream || std::rename(part.c_str(), this->report.c_str()) != 0)
  {
    const std::string reason = std::strerror(errno);
    std::remove(part.c_str());
    throw smg::Error(this->report.string() + ": the report cannot be written: " + reason + '.');
  }
}

std::function<std::string(const std::string&)> oneOf(std::vector<std::string> values)
{
  return [values = std::move(values)](const std::string& value)
  {
    if (std::find(values.begin(), values.end(), value) != values.end())
    {
      return std::string();
    }
    std::string names;
    for (const std::string& name : values)
    {
      names += names.empty() ? name : ", " + name;
    }
    return '\'' + value + "' is none of " + names;
  };
}
