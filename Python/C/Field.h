// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Jobs/MeshJob.h"
#include "IO/Jobs/ResultFile.h"
#include "Python/C/Handles.h"
#include "Python/C/Options.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/** What a job found on a mesh as it was then. */
struct smg_field
{
  std::shared_ptr<smg::SharedMesh> shared;
  std::shared_ptr<const smg::AddedColumns> added;
  std::unique_ptr<smg::MeshJob> job;
  std::unique_ptr<smg::Solution> solution;
  std::string text; ///< the one last returned

  const smg::StoredMesh& stored() const
  {
    return this->added ? static_cast<const smg::StoredMesh&>(*this->added) : this->shared->mesh();
  }

  /** What the mesh has with the result. */
  smg::StreamInfo info() const;
  /** The columns of the vertices that the job has made; also "Position" if it moves them. */
  std::vector<std::string> resultColumns() const;
  /** Passes the mesh with the result to `read` and completes the report. Throws Error; Cancelled.
   */
  void pass(const smg::MeshJob::Reader& read, const smg::ProgressFunction& progress);
  /** The report with what follows from the result, for which the mesh is read the first time. */
  const smg::Report& report(const smg::ProgressFunction& progress);
  /** The mesh with the result as a .vsm file in the scratch folder, which is written the first
   * time.
   */
  const std::filesystem::path& file(const smg::ProgressFunction& progress);
  /** The folder of file(), which blocks share. */
  const std::shared_ptr<smg::ScratchFolder>& scratch() const { return this->Scratch; }

private:
  std::optional<smg::Report> Complete;
  std::shared_ptr<smg::ScratchFolder> Scratch;
  std::filesystem::path File;
};

namespace smg
{

/** Adds the added columns to vertices of no cell; null: there are none. */
CompleteIsolated isolatedOf(const std::shared_ptr<const AddedColumns>& added);

/** Where the result of a job on a mesh is written; with no job, the mesh itself. `merged`: see
 * mergedValues(). */
ResultFile resultFile(const SharedMesh& mesh, const std::shared_ptr<const AddedColumns>& added,
  const MeshJob* job, const char* path, const WritingOptions& writing,
  CompleteIsolated merged = {});

} // namespace smg
