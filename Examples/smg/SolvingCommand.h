// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MeshCommand.h"

#include "smg/SolvedMesh.h"

#include <string>
#include <vector>

/** Base of the commands that solve equations on a mesh: the options of the solver, its warnings and
 * figures. */
class SolvingCommand : public MeshCommand
{
protected:
  using MeshCommand::MeshCommand;

  /** Adds IN, OUT and the options of the solver, except the tolerance. `result` describes
   * OUT. */
  void addSolverOptions(CLI::App& command, const std::string& result, smg::SolveOptions& options);
  /** Whether a tolerance is one: "", or what is wrong. CLI::Range includes its ends and accepts
   * nan.
   */
  static std::string checkTolerance(const std::string& text);
  /** Adds the option --tolerance. */
  template <class Number>
  static CLI::Option* addTolerance(CLI::App& command, Number& tolerance)
  {
    return command
      .add_option("--tolerance", tolerance, "Relative residual to stop at, between 0 and 1")
      ->check(checkTolerance);
  }

  /** Reads the file that says what to do, once: it may be a pipe. Throws smg::Error. */
  const std::string& readText();
  /** The same, when it has been read. */
  const std::string& text() const override { return this->Text; }
  double tolerance() const override { return this->solveOptions().tolerance; }
  /** Applies --checkpoint, for a solve on this mesh. */
  void applyCheckpoint(smg::SolveOptions& options, const smg::VsmReader& mesh) const;

  /** Applies the common options. */
  void applyTo(smg::SolveOptions& options, smg::ProgressFunction progress) const;
  /** The same on a copy, for an estimate. */
  template <class Options>
  Options withCommon(Options options) const
  {
    this->applyTo(options, {});
    options.checkpoint.folder = this->checkpoint;
    return options;
  }

  /** The options last used by solveOn(). */
  virtual const smg::SolveOptions& solveOptions() const = 0;
  std::int64_t memoryLimit() const override { return this->solveOptions().memoryLimit; }
  void warn(const smg::Report& report) const override;
  void print(const smg::Report& report) const override;

private:
  std::string Text; ///< of the file that says what to do
};
