// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CommonOptions.h"
#include "JobOptions.h"

#include "IO/Conversion/JobEstimate.h"
#include "IO/Jobs/Jobs.h"
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

/** The command of a job on a mesh: opens the mesh, computes, writes the mesh with the result and
 * reports. Derived are those that do more than any job. */
class MeshCommand : public CommonOptions
{
public:
  explicit MeshCommand(const smg::JobKind& kind);
  virtual ~MeshCommand() = default;

  /** The exit code of a command whose result is written, but does not have the accuracy asked for.
   */
  static constexpr int NotConverged = 3;

  /** Adds IN, OUT, the options of the job, those of the input and the common ones. */
  virtual void addOptions(CLI::App& command);
  /** As CommonOptions::checkUsage(). */
  virtual void checkUsage() const { this->job().check(); }
  /** Runs the command; returns its exit code. Throws smg::Error. */
  int run();

protected:
  /** Whether the option of the job with this key was given. */
  bool isGiven(std::string_view key) const { return this->Options.isGiven(key); }

  /** Whether the processes of mpiexec work together, instead of each for itself. */
  virtual bool isForProcesses() const { return false; }
  /** What is computed; the options fill it. */
  smg::MeshJob& job() { return *this->Job; }
  const smg::MeshJob& job() const { return *this->Job; }
  /** The same if it solves equations; else null. */
  smg::SolvingJob* solving() const { return this->Solving; }
  /** Does what run() does, without the end of a cancelled command. */
  virtual void compute();
  /** The files that the command reads and writes, but the report. */
  virtual smg::UsedFiles files() const;
  /** Checks the files and reads the task. */
  smg::ResultFile prepareFiles();
  /** Prints what the user is to know at the end. */
  void tell(const smg::Report& report);
  bool isDryRun() const { return this->DryRun; }
  /** That of the progress bar. */
  const char* title() const { return this->Kind.verb; }
  /** Reads the task file, before the mesh is read. */
  virtual void readTask() {}
  /** Reads the file that says what to do, once: it may be a pipe. Throws smg::Error. */
  const std::string& readText();
  /** The same, when it has been read; empty: there is none. */
  const std::string& text() const { return this->Text; }
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
  virtual double tolerance() const
  {
    return this->solving() ? this->solving()->options().tolerance : 0.0;
  }
  /** Writes what there is besides OUT and the report. */
  virtual void writeMore(const smg::Report& /*report*/) const {}
  /** Warns of what the user must know at once. */
  virtual void warn(const smg::Report& report) const;
  /** Prints what was found; what it cost follows. */
  virtual void print(const smg::Report& report) const;
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

  const smg::JobKind& Kind;
  std::unique_ptr<smg::MeshJob> Job;
  smg::SolvingJob* Solving; ///< the same
  std::string Text;         ///< of `File`
  JobOptions Options;
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
  std::unique_ptr<smg::Solution> Solution;
  bool DryRun = false;
  bool Converged = true;
};

/** Adds the command of a job that needs no other one. */
void addJobCommand(CLI::App& program, Action& action, const smg::JobKind& kind);
