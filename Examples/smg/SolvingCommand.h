// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MeshCommand.h"

#include "smg/Solve.h"

#include <string>
#include <vector>

/** Base of the commands that solve equations on a mesh: the options of the solver, its warnings and
 * figures. */
class SolvingCommand : public MeshCommand
{
protected:
  using MeshCommand::MeshCommand;

  /** Adds IN, OUT, which `result` describes, and the options of the job and of the solver. */
  void addSolverOptions(CLI::App& command, const std::string& result);

  /** Reads the file that says what to do, once: it may be a pipe. Throws smg::Error. */
  const std::string& readText();
  /** The same, when it has been read. */
  const std::string& text() const override { return this->Text; }
  double tolerance() const override { return this->solveOptions().tolerance; }

  smg::SolvingJob& job() override = 0;
  const smg::SolveOptions& solveOptions() const
  {
    return const_cast<SolvingCommand*>(this)->job().options();
  }
  void warn(const smg::Report& report) const override;
  void print(const smg::Report& report) const override;

private:
  std::string Text; ///< of the file that says what to do
};
