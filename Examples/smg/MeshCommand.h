// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CommonOptions.h"
#include "JobOptions.h"

#include "IO/Conversion/JobEstimate.h"
#include "IO/Jobs/MeshJob.h"
#include "IO/Jobs/ResultFile.h"
#include "smg/Convert.h"
#include "smg/MeshSource.h"
#include "smg/Solve.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/** Base of the commands that compute something on a mesh: opens the mesh, computes, writes the mesh
 * with the result and reports. */
class MeshCommand : public CommonOptions
{
public:
  virtual ~MeshCommand() = default;

  /** The exit code of a command whose result is written, but does not have the accuracy asked for.
   */
  static constexpr int NotConverged = 3;

  /** As CommonOptions::checkUsage(). */
  virtual void checkUsage() const {}
  /** Runs the command; returns its exit code. Throws smg::Error. */
  int run();

protected:
  /** `title` is the title of the progress bar. */
  explicit MeshCommand(std::string title)
    : Title(std::move(title))
  {
  }

  /** Adds IN and OUT; `result` describes OUT. */
  void addFiles(CLI::App& command, const std::string& result);
  /** Adds the options of the job. */
  void addJobOptions(CLI::App& command) { this->Options.addTo(command, this->job()); }
  /** Whether the option of the job with this key was given. */
  bool isGiven(std::string_view key) const { return this->Options.isGiven(key); }
  /** Adds the options of the input and the common ones. */
  void addInputAndCommon(CLI::App& command);

  /** Whether the processes of mpiexec work together, instead of each for itself. */
  virtual bool isForProcesses() const { return false; }
  /** What is computed; the options fill it. */
  virtual smg::MeshJob& job() = 0;
  const smg::MeshJob& job() const { return const_cast<MeshCommand*>(this)->job(); }
  /** Does what run() does, without the end of a cancelled command. */
  virtual void compute();
  /** The files that the command reads and writes, but the report. */
  virtual smg::UsedFiles files() const;
  /** Checks the files and reads the task. */
  smg::ResultFile prepareFiles();
  /** Prints what the user is to know at the end. */
  void tell(const smg::Report& report);
  bool isDryRun() const { return this->DryRun; }
  const std::string& title() const { return this->Title; }
  /** Reads the task file, before the mesh is read. */
  virtual void readTask() {}
  /** Reads all that the job is asked: the command line takes precedence over the file. */
  void readJob();
  /** What the computation is expected to cost on such a mesh. */
  virtual smg::Costs costsOn(const smg::StreamInfo& info) const
  {
    return this->job().costsOn(info);
  }
  /** Computes the result; foreseeable failures are reported first. */
  virtual std::unique_ptr<smg::Solution> solveOn(
    const smg::StoredMesh& mesh, const smg::ProgressFunction& progress);
  /** The relative residual to stop at; 0: there is none. */
  virtual double tolerance() const { return 0.0; }
  /** What `File` holds; empty: there is none. */
  virtual const std::string& text() const;
  /** Writes what there is besides OUT and the report. */
  virtual void writeMore(const smg::Report& /*report*/) const {}
  /** Warns of what the user must know at once. */
  virtual void warn(const smg::Report& report) const;
  /** Prints what was found; what it cost follows. */
  virtual void print(const smg::Report& report) const = 0;
  /** Of a report as a page, without what it draws. */
  html::PageFacts pageFacts() const;
  std::filesystem::path In, Out;
  std::filesystem::path File; ///< the task: problem or handles
  /** The report on the conversion of IN; none if IN is a .vsm file. */
  std::optional<smg::ConversionReport> Conversion;

private:
  /** The costs of the command, before it starts. */
  smg::JobEstimate estimate(const smg::ResultFile& out) const;
  void checkRoom(const smg::ResultFile& out) const;
  /** Computes, writes OUT and returns the report. */
  smg::Report solveAndWrite(
    const smg::StoredMesh& mesh, const smg::ResultFile& out, const smg::ProgressFunction& progress);
  /** Reads the mesh with its result once more, for the page of the report. */
  html::ResultSurface draw(
    const smg::StoredMesh& mesh, const smg::Report& report, const smg::ProgressFunction& progress);

  JobOptions Options;
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
  std::string Title;
  std::unique_ptr<smg::Solution> Solution;
  bool DryRun = false;
  bool Converged = true;
};
