// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "HtmlReport/Page.h"

#include "IO/Formats/UsedFiles.h"
#include "smg/Convert.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace smg
{
struct JobEstimate;
}

/** How a file that is no .vsm is read. */
struct InputOptions
{
  std::string cells; ///< triangles, tets, or empty: the only ones
  std::optional<double> weld;
  std::int64_t timeStep = 0;
  std::optional<std::int64_t> partition;
};

/** The options that every command has, and what most do with them. */
struct CommonOptions
{
  InputOptions input;
  std::filesystem::path report;     ///< file for the report; empty: none
  std::int64_t memory = 0;          ///< bytes; 0: the default of the operation
  int threads = 0;                  ///< 0: one per core
  std::filesystem::path scratch;    ///< empty: the system's temporary folder
  std::int64_t scratchLimit = 0;    ///< bytes of the scratch files at once; 0: none
  std::filesystem::path checkpoint; ///< folder, of commands that have one; empty: none
  bool quiet = false;
  bool writesText = false; ///< of the mesh that is written, of commands that write one

  /**
   * Adds the options to a command, except --threads. `memoryDefault` is the default of --memory,
   * `moreOnMemory` ends its description.
   */
  void addTo(CLI::App& command, const std::string& memoryDefault = "256",
    const std::string& moreOnMemory = {});
  /** Adds --cells, --weld, --time-step and --partition. */
  void addInputTo(CLI::App& command);
  /** Adds --text. */
  void addTextTo(CLI::App& command);
  /** Adds --threads. */
  void addThreadsTo(CLI::App& command);

  /** Adds --checkpoint. */
  void addCheckpointTo(CLI::App& command);
  /** What is wrong with the options, whatever the files say: throws CLI::Error or smg::Error. */
  void checkUsage() const {}

  /** How the mesh file is converted within the memory limit. */
  smg::ConversionOptions inputOptions() const;
  /** Opens a mesh file of any format. A file that is not a stream is converted to `order`, with
   * these groups coupled; with a checkpoint, it is kept there. Throws smg::Error. */
  std::unique_ptr<smg::OpenedMesh> openInput(const std::filesystem::path& path,
    smg::ProgressFunction progress, smg::StreamOrder order = smg::StreamOrder::BreadthFirst,
    const smg::CoupledGroups& coupled = {}) const;

  /** Adds what the conversion of an opened mesh left out or changed, if it was converted. */
  static void addNotes(const smg::OpenedMesh& mesh, std::vector<std::string>& notes);

  /** The folder of the scratch files, or of what exists of it; empty: the temporary one. */
  std::filesystem::path scratchPlace() const;
  /** The bytes that a checkpoint has. */
  std::int64_t checkpointBytes() const;
  /** Throws smg::Error if one of these files would be in the folder of the checkpoint. */
  void checkCheckpoint(std::initializer_list<std::filesystem::path> results) const;
  /** Tells of a checkpoint after some "pass" or other `step`; where the command really continues,
   * when the files agree with their checksums, is a note of its report. To be called before the
   * work. */
  void announceCheckpoint(const char* step) const;

  /** Ends a cancelled command: throws smg::Error that says how to continue it, or smg::Cancelled if
   * there is no checkpoint. */
  [[noreturn]] void endCancelled() const;

  /** The memory limit in bytes, or `fallback` if none was given. */
  std::int64_t memoryBytes(std::int64_t fallback) const
  {
    return this->memory > 0 ? this->memory : fallback;
  }

  /** Prints what the command is expected to cost, and which limits are below that. */
  void printEstimate(const smg::JobEstimate& estimate) const;

  /** Checks all files of a command, once before the work: `files` are all but the report. Throws
   * smg::Error if one that is written is another one of them, or a requested report cannot be
   * written. */
  void checkFiles(smg::UsedFiles files) const;
  /** Whether the report is requested as a page for a person, by the suffix .html or .htm. */
  bool reportsPage() const;
  /** Writes the report if one is requested, as it is or as a page with these facts. Throws
   * smg::Error. */
  void writeReport(const std::string& json, const html::PageFacts& facts) const;
};

/** Checks that the value of an option is one of these; the error lists them. */
std::function<std::string(const std::string&)> oneOf(std::vector<std::string> values);
/** Checks that the value of an option is a whole number from 0 on. */
std::string wholeNumber(const std::string& value);

/** Bytes as MiB. */
inline double inMebibytes(std::int64_t bytes)
{
  return static_cast<double>(bytes) / (1 << 20);
}

/** Runs the selected command; returns its exit code. */
using Action = std::function<int()>;

/** Adds a command with options, which is made of `more` and sets `action` when it is selected. */
template <class Command>
void addCommand(CLI::App& program, Action& action, const std::string& name,
  const std::string& description, const auto&... more)
{
  const auto command = std::make_shared<Command>(more...);
  CLI::App* added = program.add_subcommand(name, description);
  command->addOptions(*added);
  added->callback(
    [command, &action]
    {
      try
      {
        command->checkUsage();
      }
      catch (const smg::Error& error)
      {
        throw CLI::ValidationError(error.what());
      }
      action = [command] { return command->run(); };
    });
}

/** Throws smg::Error if mpiexec has started several processes, which would all do the same and
 * write the same files. */
void requireOneProcess();
