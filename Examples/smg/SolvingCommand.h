// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CommonOptions.h"
#include "InputOptions.h"

#include "smg/Convert.h"
#include "smg/Solve.h"
#include "smg/VsmReader.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

/** Base of `solve` and `deform`: opens the mesh, solves on it, writes it with the result and
 * reports. */
class SolvingCommand : public CommonOptions
{
public:
  virtual ~SolvingCommand() = default;

  /** Runs the command. Throws smg::Error. */
  void run();

protected:
  /** `title` is the title of the progress bar. */
  explicit SolvingCommand(std::string title)
    : Title(std::move(title))
  {
  }

  /** Adds IN, OUT and the options of the solver, except the tolerance. `result` describes OUT,
   * `operators` are the available operator sets. */
  void addSolverOptions(CLI::App& command, const std::string& result, smg::SolveOptions& options,
    std::vector<std::string> operators = { "extended" });
  /** Adds the option --tolerance. */
  template <class Number>
  static CLI::Option* addTolerance(CLI::App& command, Number& tolerance)
  {
    return command
      .add_option("--tolerance", tolerance, "Relative residual to stop at, between 0 and 1")
      ->check(checkTolerance);
  }

  /** Applies the common options. */
  void applyTo(smg::SolveOptions& options, smg::ProgressFunction progress) const;

  /** Throws smg::Error, before the work, if the name of the output is invalid. */
  virtual void checkOutputName() const = 0;
  /** Reads the task file, before the mesh is read. */
  virtual void readTask() = 0;
  /** Solves; foreseeable failures are reported first. */
  virtual std::unique_ptr<smg::Solution> solveOn(
    const smg::VsmReader& mesh, smg::ProgressFunction progress) = 0;
  /** Whether write() rewrites the file IN as OUT, in the order of IN. */
  virtual bool rewritesInput() const { return false; }
  /** Whether write() writes OUT in the order of IN. */
  virtual bool keepsOrder() const { return this->rewritesInput(); }
  /** The treatment of this many isolated vertices in an output with all of IN, as the end of a
   * sentence. */
  virtual std::string fateOfIsolated(std::int64_t vertices) const
  {
    return vertices == 1 ? "stays where it is." : "stay where they are.";
  }
  /** Writes the output and returns notes for the user. May add to the report. */
  virtual std::vector<std::string> write(const smg::VsmReader& mesh, smg::Solution& solution,
    smg::Report& report, const smg::ProgressFunction& progress) const = 0;
  /** The options last used by solveOn(). */
  virtual const smg::SolveOptions& solveOptions() const = 0;

  std::filesystem::path In, Out;
  InputOptions Input;         ///< of a file that is not a .vsm
  std::filesystem::path File; ///< the task: problem or handles
  /** The report on the conversion of IN; none if IN is a .vsm file. */
  std::optional<smg::ConversionReport> Conversion;

private:
  /** CLI::Range includes its ends and accepts nan. */
  static std::string checkTolerance(const std::string& text);
  /** Notes for the user on the conversion of IN. */
  std::vector<std::string> notesOn(const smg::ConversionReport& conversion) const;
  /** Warns of steps that did not converge. */
  void warn(const smg::Report& report) const;
  void print(const smg::Report& report) const;

  std::string Title;
};
