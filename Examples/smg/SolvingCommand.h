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

/**
 * What `solve` and `deform` have in common: open the mesh, solve on it, write it with the result,
 * report.
 */
class SolvingCommand : public CommonOptions
{
public:
  virtual ~SolvingCommand() = default;

  /** Runs the command. Throws smg::Error. */
  void run();

protected:
  /** What the progress bar calls the work. */
  explicit SolvingCommand(std::string title)
    : Title(std::move(title))
  {
  }

  /**
   * Adds IN, OUT and the options of the solver, all but the tolerance. `result` says what OUT is,
   * `operators` which operator sets there are.
   */
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

  /** Fills in what the common options say. */
  void applyTo(smg::SolveOptions& options, smg::ProgressFunction progress) const;

  /** Refuses an output, before the work, as far as its name says. */
  virtual void checkOutputName() const = 0;
  /** Reads the file that says what to do, before the mesh is read. */
  virtual void readTask() = 0;
  /** Solves; what can be known to fail is refused first. */
  virtual std::unique_ptr<smg::Solution> solveOn(
    const smg::VsmReader& mesh, smg::ProgressFunction progress) = 0;
  /** Whether write() makes OUT of the file IN, in the order of that. */
  virtual bool rewritesInput() const { return false; }
  /** Whether write() brings OUT into the order of IN. */
  virtual bool keepsOrder() const { return this->rewritesInput(); }
  /** What becomes of so many vertices of no cell in an output that has all of IN, as the end of a
   * sentence. */
  virtual std::string fateOfIsolated(std::int64_t vertices) const
  {
    return vertices == 1 ? "stays where it is." : "stay where they are.";
  }
  /** Writes the output; answers what a user should know of it. May add to the report. */
  virtual std::vector<std::string> write(const smg::VsmReader& mesh, smg::Solution& solution,
    smg::Report& report, const smg::ProgressFunction& progress) const = 0;
  /** Those that solveOn() used last. */
  virtual const smg::SolveOptions& solveOptions() const = 0;

  std::filesystem::path In, Out;
  InputOptions Input;         ///< of what is no .vsm file
  std::filesystem::path File; ///< says what to do
  /** What was done to IN, once it is open; none: it is a .vsm file. */
  std::optional<smg::ConversionReport> Conversion;

private:
  /** CLI::Range includes its ends and takes nan. */
  static std::string checkTolerance(const std::string& text);
  /** What a user should know of the mesh that was made of IN. */
  std::vector<std::string> notesOn(const smg::ConversionReport& conversion) const;
  /** Says what did not converge. */
  void warn(const smg::Report& report) const;
  void print(const smg::Report& report) const;

  std::string Title;
};
