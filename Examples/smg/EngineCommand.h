// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DistributedEngine.h"
#include "MeshCommand.h"

#include <filesystem>
#include <memory>
#include <string>

/** Base of the commands that two engines have: one process streams, or the processes of mpiexec
 * solve together. */
class EngineCommand : public MeshCommand
{
protected:
  using MeshCommand::MeshCommand;

  /** Adds the options --engine, --explain and --trace; addOptions() comes first. */
  void addEngineTo(CLI::App& command);
  bool isForProcesses() const override { return this->Engine == "hypre"; }
  void compute() override;
  /** With --explain, the table of the stages follows. */
  void print(const smg::Report& report) const override;

  /** Does the job on all processes. */
  virtual void computeOn(const DistributedEngine& engine, const DistributedJob& job) = 0;
  /** After readTask(): throws smg::Error for what the processes of mpiexec do not do. */
  virtual void checkForProcesses() const {}

  /** Those of the other engine are past when this one's result is written. */
  smg::Costs costsOn(const smg::StreamInfo& info) const override
  {
    return this->Whole ? smg::Costs{} : this->MeshCommand::costsOn(info);
  }
  std::unique_ptr<smg::Solution> solveOn(
    const smg::StoredMesh& mesh, const smg::ProgressFunction& progress) override;

  smg::UsedFiles files() const override
  {
    smg::UsedFiles files = this->MeshCommand::files();
    files.write(this->Trace, "trace");
    return files;
  }

private:
  void computeTraced();
  void checkDistributed();

  std::string Engine = "streaming";
  bool Explain = false;
  std::filesystem::path Trace; ///< file of the trace; empty: none
  CLI::Option* MaxCycles = nullptr;
  /** The solution of the processes of mpiexec, which the first one writes. */
  smg::Solution* Whole = nullptr;
};
