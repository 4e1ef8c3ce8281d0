// SPDX-License-Identifier: BSD-3-Clause
#include "CommonOptions.h"

#include "IO/Conversion/ConversionEstimate.h"
#include "IO/Conversion/JobEstimate.h"
#include "IO/Description/Sizes.h"
#include "IO/Files/FileNames.h"
#include "IO/Formats/FormatTable.h"
#include "Solver/Checkpoint/Checkpoint.h"
#include "Solver/Core/Text.h"
#include "Solver/Files/FileDescriptor.h"
#include "Solver/Files/ScratchAccount.h"
#include "smg/Error.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <utility>

namespace
{

/** Replaces a size with a unit, or a number of MiB, by its bytes. Returns what is wrong with it. */
std::string toBytes(std::string& text)
{
  constexpr std::int64_t Most = std::int64_t(1) << 30; // MiB
  try
  {
    const std::optional<double> bytes = smg::bytesOf(text);
    std::string mebibytes =
      bytes ? std::to_string(static_cast<std::int64_t>(*bytes / (1 << 20))) : text;
    std::string error = CLI::Range(std::int64_t(1), Most)(mebibytes);
    if (error.empty())
    {
      std::int64_t number = 0;
      CLI::detail::lexical_cast(mebibytes, number);
      text = std::to_string(bytes ? static_cast<std::int64_t>(*bytes) : number << 20);
      return {};
    }
    return '\'' + text + "' is no size from 1 to " + std::to_string(Most) +
           " MiB: give a whole number of MiB, or a number with a unit, as 2GiB";
  }
  catch (const smg::Error& error)
  {
    return error.what();
  }
}

} // namespace

void CommonOptions::addTo(
  CLI::App& command, const std::string& memoryDefault, const std::string& moreOnMemory)
{
  command
    .add_option("--report", this->report,
      "Write the report to this file: in JSON, or with the suffix .html as a page with figures and "
      "a picture of the result, for any browser")
    ->type_name("FILE");
  command
    .add_option("--memory", this->memory,
      "Memory limit in MiB, or with a unit, as 2GiB: K, M, G, T, KiB to TiB (powers of 1024), KB "
      "to "
      "TB (of 1000)" +
        moreOnMemory)
    ->transform(CLI::Validator(toBytes, ""))
    ->default_str(memoryDefault)
    ->type_name("MiB");
  command.add_option("--scratch", this->scratch, "Folder for scratch files")
    ->check(CLI::ExistingDirectory)
    ->default_str("$TMPDIR or /tmp")
    ->type_name("DIR");
  command
    .add_option_function<std::int64_t>(
      "--scratch-limit",
      [this](std::int64_t limit)
      {
        this->scratchLimit = limit;
        smg::ScratchAccount::process().setLimit(this->scratchLimit);
      },
      "Limit of the bytes of scratch files that exist at once, in MiB or with a unit; without it "
      "there is none")
    ->transform(CLI::Validator(toBytes, ""))
    ->type_name("MiB");
  command.add_flag_callback(
    "--no-sync", [] { smg::FileDescriptor::setDurable(false); },
    "Do not wait until the results are on the disk, where a power cut cannot destroy them");
  command.add_flag("--quiet", this->quiet,
    "No progress (a bar on a terminal, else a line every ten seconds) and no summary");
}

namespace
{

/** Whether a file is in a folder or below it; neither need exist. */
bool isIn(const std::filesystem::path& file, const std::filesystem::path& folder)
{
  const auto named = [](const std::filesystem::path& path)
  {
    const auto whole = std::filesystem::weakly_canonical(std::filesystem::absolute(path));
    return whole.has_filename() ? whole : whole.parent_path();
  };
  const std::filesystem::path inner = named(file), outer = named(folder);
  return std::ranges::mismatch(outer, inner).in1 == outer.end();
}

} // namespace

void CommonOptions::addInputTo(CLI::App& command)
{
  command
    .add_option(
      "--cells", this->input.cells, "Cells to keep of a mesh with both types: triangles or tets")
    ->check(oneOf({ "triangles", "tets" }));
  command
    .add_option("--weld", this->input.weld,
      "Merge points within this distance of each other; 0: equal coordinates")
    ->check(
      [](const std::string& value)
      {
        char* end = nullptr;
        const double distance = std::strtod(value.c_str(), &end);
        const bool isDistance =
          end != value.c_str() && *end == '\0' && std::isfinite(distance) && distance >= 0.0;
        return isDistance ? std::string() : '\'' + value + "' is not a finite distance from 0 on";
      })
    ->type_name("DISTANCE");
  command
    .add_option(
      "--time-step", this->input.timeStep, "Which time step to read of a VTKHDF file, from 0")
    ->check(wholeNumber)
    ->capture_default_str()
    ->type_name("N");
  command
    .add_option("--partition", this->input.partition,
      "Which partition to read of a VTKHDF file, from 0; all, joined, unless given")
    ->check(wholeNumber)
    ->type_name("K");
}

void CommonOptions::addTextTo(CLI::App& command)
{
  command.add_flag("--text", this->writesText,
    "Write text where OUT may be binary or text (" +
      smg::suffixList(smg::FormatUse::WriteEither, "or") +
      "), for programs that read no binary files; numbers read back exactly");
}

smg::ConversionOptions CommonOptions::inputOptions() const
{
  smg::ConversionOptions options;
  options.cells = this->input.cells.empty()          ? smg::CellChoice::Only
                  : this->input.cells == "triangles" ? smg::CellChoice::Triangles
                                                     : smg::CellChoice::Tetrahedra;
  options.weld = this->input.weld;
  options.timeStep = this->input.timeStep;
  options.partition = this->input.partition;
  options.memoryLimit = this->memoryBytes(0);
  options.codec = smg::Codec::Lz4;
  options.scratch = this->scratch;
  options.threads = this->threads;
  return options;
}

std::unique_ptr<smg::OpenedMesh> CommonOptions::openInput(const std::filesystem::path& path,
  smg::ProgressFunction progress, smg::StreamOrder order, const smg::CoupledGroups& coupled) const
{
  smg::ConversionOptions options = this->inputOptions();
  options.order = order;
  options.coupled = coupled;
  options.checkpoint = this->checkpoint;
  options.progress = std::move(progress);
  return smg::openMesh(path, options);
}

void CommonOptions::addNotes(const smg::OpenedMesh& mesh, std::vector<std::string>& notes)
{
  if (const smg::ConversionReport* conversion = mesh.conversion())
  {
    const std::vector<std::string> changes = conversion->changes();
    notes.insert(notes.end(), changes.begin(), changes.end());
    notes.insert(notes.end(), conversion->notes.begin(), conversion->notes.end());
  }
}

void CommonOptions::addThreadsTo(CLI::App& command)
{
  command.add_option("--threads", this->threads, "Compute threads; 0: one per core")
    ->check(CLI::Range(0, 1024))
    ->capture_default_str()
    ->type_name("N");
}

void CommonOptions::addCheckpointTo(CLI::App& command)
{
  command
    .add_option("--checkpoint", this->checkpoint,
      "Folder from which the same command, run again, continues if it was killed; it is made, and "
      "removed when OUT is complete")
    ->check([](const std::string& folder)
      { return folder.empty() ? std::string("an empty text is not a folder") : std::string(); })
    ->type_name("DIR");
}

std::filesystem::path CommonOptions::scratchPlace() const
{
  if (this->checkpoint.empty())
  {
    return this->scratch;
  }
  std::filesystem::path place = std::filesystem::absolute(this->checkpoint);
  while (!std::filesystem::exists(place) && place.has_relative_path())
  {
    place = place.parent_path();
  }
  return place;
}

std::int64_t CommonOptions::checkpointBytes() const
{
  std::int64_t bytes = 0;
  std::error_code unknown;
  for (std::filesystem::directory_iterator entry(this->checkpoint, unknown), end; entry != end;
       entry.increment(unknown))
  {
    const std::uintmax_t size = entry->file_size(unknown);
    bytes += unknown ? 0 : static_cast<std::int64_t>(size);
  }
  return bytes;
}

void CommonOptions::endCancelled() const
{
  if (!this->checkpoint.empty() && std::filesystem::exists(this->checkpoint))
  {
    throw smg::Error(
      "cancelled: the same command continues from the checkpoint in " + this->checkpoint.string());
  }
  throw smg::Cancelled();
}

void CommonOptions::checkCheckpoint(std::initializer_list<std::filesystem::path> results) const
{
  // With a file in it, it is in the folder or is the folder itself.
  if (!this->checkpoint.empty() && !this->scratch.empty() &&
      isIn(this->scratch / "file", this->checkpoint))
  {
    throw smg::Error(this->scratch.string() +
                     ": is or lies in the folder of the checkpoint, which is removed at the end: "
                     "choose another folder for --scratch.");
  }
  for (const std::filesystem::path& result : results)
  {
    if (!this->checkpoint.empty() && !result.empty() &&
        isIn(smg::FileDescriptor::targetOf(result), this->checkpoint))
    {
      throw smg::Error(
        result.string() +
        ": lies in the folder of the checkpoint, which is removed at the end: choose "
        "another place for one of them.");
    }
  }
}

void CommonOptions::announceCheckpoint(const char* step) const
{
  const std::int64_t steps =
    this->checkpoint.empty() ? 0 : smg::Checkpoint::steps(this->checkpoint);
  if (steps > 0 && !this->quiet)
  {
    std::fprintf(stderr, "smg: found a checkpoint after %s %lld in %s\n", step,
      static_cast<long long>(steps), this->checkpoint.c_str());
  }
}

namespace
{

/** Whether the report is written in place: to a pipe or to a device. */
bool isInPlace(const std::filesystem::path& report)
{
  const std::filesystem::file_status status = std::filesystem::status(report);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

[[noreturn]] void failReport(const std::filesystem::path& report, const std::string& reason)
{
  throw smg::Error(report.string() + ": the report cannot be written: " + reason + '.');
}

} // namespace

void CommonOptions::checkFiles(smg::UsedFiles files) const
{
  files.write(this->report, "report");
  files.check();
  if (this->report.empty())
  {
    return;
  }
  if (std::filesystem::is_directory(this->report))
  {
    failReport(this->report, std::strerror(EISDIR));
  }
  if (isInPlace(this->report))
  {
    return;
  }
  smg::FileDescriptor::createBeside(this->report); // removed at once
}

bool CommonOptions::reportsPage() const
{
  const std::string suffix = smg::lowerSuffix(this->report);
  return suffix == ".html" || suffix == ".htm";
}

void CommonOptions::writeReport(const std::string& json, const html::PageFacts& facts) const
{
  if (this->report.empty())
  {
    return;
  }
  const std::string text = this->reportsPage() ? html::page(json, facts) : json + '\n';
  if (!isInPlace(this->report))
  {
    smg::writeFile(this->report, text);
    return;
  }
  std::ofstream stream(this->report);
  stream << text;
  stream.close();
  if (!stream)
  {
    failReport(this->report, std::strerror(errno));
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

void requireOneProcess()
{
  // Of Open MPI, and of MPICH and Slurm.
  for (const char* name : { "OMPI_COMM_WORLD_SIZE", "PMI_SIZE" })
  {
    const char* size = std::getenv(name);
    if (size && std::atoi(size) > 1)
    {
      throw smg::Error(std::string(size) +
                       " processes were started, which would all do the same and "
                       "write the same files: start smg once, or solve or deform with them "
                       "together (--engine hypre).");
    }
  }
}

void CommonOptions::printEstimate(const smg::JobEstimate& estimate) const
{
  std::printf("%s%lld vertices, %s\n", estimate.counted ? "" : "about ",
    static_cast<long long>(estimate.vertices),
    smg::counted(estimate.cells, "cell", "cells").c_str());
  const auto line = [](const char* what, std::int64_t bytes)
  { std::printf("  %-8s about %.0f MiB", what, inMebibytes(bytes)); };
  const auto limit = [](std::int64_t bytes, std::int64_t most, const char* option)
  {
    std::printf(", the limit is %.0f MiB", inMebibytes(most));
    if (bytes > most)
    {
      std::printf(", which is too low: raise %s", option);
    }
  };
  line("memory", estimate.memory_bytes);
  limit(estimate.memory_bytes, estimate.memory_limit, "--memory");
  std::printf("\n");
  line("scratch", estimate.scratch_bytes);
  if (this->scratchLimit > 0)
  {
    limit(estimate.scratch_bytes, this->scratchLimit, "--scratch-limit");
  }
  std::printf(", %s\n", smg::freeSpace(estimate.scratch_free).c_str());
  line("output", estimate.output_bytes);
  std::printf(", %s\n", smg::freeSpace(estimate.output_free).c_str());
  if (estimate.passes > 0)
  {
    std::printf("  passes   about %d\n", estimate.passes);
  }
  std::printf("  time     about %.0f s of CPU\n", estimate.cpu_seconds);
}
