// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CommonOptions.h"
#include "ResultFile.h"

#include "IO/Conversion/JobEstimate.h"
#include "smg/Convert.h"
#include "smg/Region.h"
#include "smg/Solve.h"
#include "smg/VsmReader.h"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/** An option that names parts of the mesh in JSON, and may be given several times. */
class PlacesOption
{
public:
  /** `name` is the name of the option, for example "--hold". */
  explicit PlacesOption(std::string name)
    : Name(std::move(name))
  {
  }

  /** Adds the option. `what` is what it names, for example "A part of the mesh that does not move".
   */
  void addTo(CLI::App& command, const std::string& what);

  /** The values given: JSON or names of files. */
  const std::vector<std::string>& given() const { return this->Given; }
  /** The parts of all options. Throws smg::Error. */
  std::vector<smg::Where> places() const;

private:
  std::vector<smg::Where> placesOf(const std::string& given) const;

  std::string Name;
  std::vector<std::string> Given;
};

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
  /** Adds the options of the input and the common ones; `memoryLimit` is the default limit. */
  void addInputAndCommon(CLI::App& command, std::int64_t memoryLimit);

  /** Whether the processes of mpiexec work together, instead of each for itself. */
  virtual bool isForProcesses() const { return false; }
  /** The columns of the result, as ResultFile::Options::columns. */
  virtual std::string resultColumns() const = 0;
  /** The names of these columns if IN has them, as ResultFile::Options::changed. */
  virtual std::vector<std::string> changedColumns() const { return {}; }
  /** Does what run() does, without the end of a cancelled command. */
  virtual void compute();
  /** Checks the files and reads the task. */
  ResultFile checkFiles();
  /** Prints what the user is to know at the end. */
  void tell(const smg::Report& report);
  bool isDryRun() const { return this->DryRun; }
  const std::string& title() const { return this->Title; }
  /** Reads the task file, before the mesh is read. */
  virtual void readTask() = 0;
  /** What the computation is expected to cost on such a mesh. */
  virtual smg::Costs costsOn(const smg::StreamInfo& info) const = 0;
  /** The values that the result has besides the mesh, or in place of its own. */
  virtual smg::AddedValues addedTo(const smg::StreamInfo& info) const = 0;
  /** Those of a result that has these columns of the vertices with other values. */
  static smg::AddedValues replacedIn(
    const smg::StreamInfo& info, const std::vector<std::string>& columns);
  /** Computes the result; foreseeable failures are reported first. */
  virtual std::unique_ptr<smg::Solution> solveOn(
    const smg::VsmReader& mesh, smg::ProgressFunction progress) = 0;
  /** The treatment of this many isolated vertices in an output with all of IN, as the end of a
   * sentence. `ordered`: the output has the order of the mesh file IN. */
  virtual std::string fateOfIsolated(std::int64_t vertices, bool /*ordered*/) const
  {
    return vertices == 1 ? "stays where it is." : "stay where they are.";
  }
  /** Writes a mesh stream, which it reads to its end, as OUT. */
  using Writer = std::function<void(smg::MeshSource& result, const smg::ProgressFunction&)>;
  /** Passes the mesh with the result, as a stream, to `write`. May add to the report. */
  virtual void writeResult(const smg::VsmReader& mesh, smg::Solution& solution, const Writer& write,
    smg::Report& report, const smg::ProgressFunction& progress) const = 0;
  /** The memory limit of solveOn(), bytes. */
  virtual std::int64_t memoryLimit() const = 0;
  /** The relative residual to stop at; 0: there is none. */
  virtual double tolerance() const { return 0.0; }
  /** What `File` holds; empty: there is none. */
  virtual const std::string& text() const;
  /** Warns of what the user must know at once. */
  virtual void warn(const smg::Report& report) const;
  /** Prints what was found; what it cost follows. */
  virtual void print(const smg::Report& report) const = 0;
  /** Of a report as a page, without what it draws. */
  html::PageFacts pageFacts() const;
  /** Bytes for the buffers of a writer while the solution holds its memory. */
  std::int64_t writerMemory() const;

  std::filesystem::path In, Out;
  std::filesystem::path File; ///< the task: problem or handles
  /** The report on the conversion of IN; none if IN is a .vsm file. */
  std::optional<smg::ConversionReport> Conversion;

private:
  /** The costs of the command, before it starts. */
  smg::JobEstimate estimate(const ResultFile& out) const;
  void checkRoom(const ResultFile& out) const;
  /** Computes, writes OUT and returns the report. */
  smg::Report solveAndWrite(
    const smg::VsmReader& mesh, const ResultFile& out, const smg::ProgressFunction& progress);
  /** Reads the mesh with its result once more, for the page of the report. */
  html::ResultSurface draw(
    const smg::VsmReader& mesh, const smg::Report& report, const smg::ProgressFunction& progress);
  /** Notes for the user on the conversion of IN. */
  std::vector<std::string> notesOn(
    const smg::ConversionReport& conversion, const ResultFile& out) const;

  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
  std::string Title;
  std::unique_ptr<smg::Solution> Solution;
  bool DryRun = false;
  bool Converged = true;
};
