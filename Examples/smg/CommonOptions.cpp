// SPDX-License-Identifier: BSD-3-Clause
#include "CommonOptions.h"

#include "Solver/Storage/FileDescriptor.h"
#include "smg/Error.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

void CommonOptions::addTo(CLI::App& command, const std::string& memoryDefault)
{
  constexpr std::int64_t MostMemory = std::int64_t(1) << 30;
  command.add_option("--report", this->report, "Write the report to this JSON file")
    ->type_name("FILE");
  command.add_option("--memory", this->memory, "Memory limit in MiB")
    ->check(CLI::Range(std::int64_t(1), MostMemory))
    ->default_str(memoryDefault)
    ->type_name("MiB");
  command.add_option("--scratch", this->scratch, "Folder for scratch files")
    ->check(CLI::ExistingDirectory)
    ->default_str("$TMPDIR or /tmp")
    ->type_name("DIR");
  command.add_flag("--quiet", this->quiet, "No progress bar and no summary");
}

void CommonOptions::addThreadsTo(CLI::App& command)
{
  command.add_option("--threads", this->threads, "Compute threads; 0: one per core")
    ->check(CLI::Range(0, 1024))
    ->capture_default_str()
    ->type_name("N");
}

namespace
{

/** Whether the report is written in place: to a pipe, to a device or through a link. */
bool isInPlace(const std::filesystem::path& report)
{
  const std::filesystem::file_status status = std::filesystem::symlink_status(report);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

/** The file to write; it is renamed when complete, so that no reader sees a partial report. */
std::filesystem::path temporaryOf(const std::filesystem::path& report)
{
  return isInPlace(report) ? report : std::filesystem::path(report.string() + ".part");
}

[[noreturn]] void failReport(const std::filesystem::path& report, const std::string& reason)
{
  throw smg::Error(report.string() + ": the report cannot be written: " + reason + '.');
}

/** Whether both name the same file, which need not exist. */
bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b)
{
  // A file that does not exist can only be compared by name.
  std::error_code absent;
  const auto named = [](const std::filesystem::path& file)
  { return std::filesystem::absolute(smg::FileDescriptor::targetOf(file)).lexically_normal(); };
  return std::filesystem::equivalent(a, b, absent) || named(a) == named(b);
}

} // namespace

void CommonOptions::checkReport(std::initializer_list<std::filesystem::path> others) const
{
  if (this->report.empty())
  {
    return;
  }
  for (const std::filesystem::path& other : others)
  {
    if (!other.empty() && sameFile(this->report, other))
    {
      throw smg::Error(this->report.string() +
                       ": the report would overwrite it: choose another name for the report.");
    }
  }
  if (std::filesystem::is_directory(this->report))
  {
    failReport(this->report, std::strerror(EISDIR));
  }
  if (isInPlace(this->report))
  {
    return;
  }
  const std::filesystem::path part = temporaryOf(this->report);
  if (!std::ofstream(part))
  {
    failReport(this->report, std::strerror(errno));
  }
  std::remove(part.c_str());
}

void CommonOptions::writeReport(const std::string& json) const
{
  if (this->report.empty())
  {
    return;
  }
  const std::filesystem::path part = temporaryOf(this->report);
  std::ofstream stream(part);
  stream << json << '\n';
  stream.close();
  const bool inPlace = part == this->report;
  if (!stream || (!inPlace && std::rename(part.c_str(), this->report.c_str()) != 0))
  {
    const std::string reason = std::strerror(errno);
    if (!inPlace)
    {
      std::remove(part.c_str());
    }
    failReport(this->report, reason);
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

std::string wholeNumber(const std::string& value)
{
  std::int64_t number = 0;
  const char* const end = value.data() + value.size();
  const auto [rest, error] = std::from_chars(value.data(), end, number);
  const bool isValid = error == std::errc() && rest == end && number >= 0;
  return isValid ? std::string() : '\'' + value + "' is not a whole number from 0 on";
}
