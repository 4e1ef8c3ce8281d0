// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "HtmlReport/Page.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace smg
{
struct JobEstimate;
}

/** The options that every command has. */
struct CommonOptions
{
  std::filesystem::path report;     ///< file for the report; empty: none
  std::int64_t memory = 0;          ///< MiB; 0: the default of the operation
  int threads = 0;                  ///< 0: one per core
  std::filesystem::path scratch;    ///< empty: the system's temporary folder
  std::filesystem::path checkpoint; ///< folder, of commands that have one; empty: none
  bool quiet = false;

  /**
   * Adds the options to a command, except --threads. `memoryDefault` is the default of --memory.
   */
  void addTo(CLI::App& command, const std::string& memoryDefault = "256");
  /** Adds --threads. */
  void addThreadsTo(CLI::App& command);

  /** Adds --checkpoint. */
  void addCheckpointTo(CLI::App& command);
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
    return this->memory > 0 ? this->memory << 20 : fallback;
  }

  /** Throws smg::Error if a requested report cannot be written or would overwrite another file of
   * the command. */
  void checkReport(std::initializer_list<std::filesystem::path> others) const;
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
/** The number that the whole text is; none if it is none. */
std::optional<double> numberOf(const std::string& text);
/** Checks that the value of an option is a finite number of at least 0. */
std::string numberFromZero(const std::string& value);

/** The parts of a list "a,b", which may be empty: as many as commas, and one. */
std::vector<std::string> splitAtCommas(const std::string& list);

/** Bytes as MiB. */
inline double inMebibytes(std::int64_t bytes)
{
  return static_cast<double>(bytes) / (1 << 20);
}

/** Prints what a command is expected to cost. */
void printEstimate(const smg::JobEstimate& estimate);

/** Runs the selected command; returns its exit code. */
using Action = std::function<int()>;

/** Add the commands to the program; each sets `action` when it is selected. */
void addInfoCommand(CLI::App& program, Action& action);
void addConvertCommand(CLI::App& program, Action& action);
void addSolveCommand(CLI::App& program, Action& action);
void addDeformCommand(CLI::App& program, Action& action);
void addSmoothCommand(CLI::App& program, Action& action);
void addBlendCommand(CLI::App& program, Action& action);
void addDistanceCommand(CLI::App& program, Action& action);
void addSimplifyCommand(CLI::App& program, Action& action);
void addPreviewCommand(CLI::App& program, Action& action);
