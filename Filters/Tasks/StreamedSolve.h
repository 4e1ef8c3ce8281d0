// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/PieceRequest.h"
#include "Filters/Tasks/JobTask.h"
#include "Filters/Tasks/SolveSummary.h"
#include "IO/Vtk/PieceInput.h"
#include "IO/Vtk/PieceStream.h"
#include "Solver/Core/Progress.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Convert.h"
#include "smg/Report.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkPointSet;

namespace smg
{

/** A solution on the mesh that an input delivers in pieces, kept with the stamp of its input. */
class StreamedSolve
{
public:
  StreamedSolve() = default;
  ~StreamedSolve() = default;
  StreamedSolve(const StreamedSolve&) = delete;
  StreamedSolve& operator=(const StreamedSolve&) = delete;

  /** How the pieces of the input are requested. */
  struct PieceReading
  {
    PieceCount pieces;
    /** Folder for scratch files; empty: the system's, or of an ordinary mesh the memory. */
    std::filesystem::path scratch;
    std::int64_t scratchLimit = 0; ///< of the bytes of all scratch files at once; 0: none
    std::int64_t memory = 0;       ///< limit in bytes
    int threads = 0;               ///< 0: one per core
  };

  /** Whether there is a solution for this stamp. */
  bool isFor(const InputStamp& stamp) const { return this->Result && this->MadeFor == stamp; }

  /** Releases a solution for another stamp, whose files may be large, with its checkpoint. */
  void keepOnlyFor(const InputStamp& stamp)
  {
    if (!this->isFor(stamp))
    {
      this->discard();
    }
  }

  /** Sets the stamp of the solution. */
  void setStamp(const InputStamp& stamp) { this->MadeFor = stamp; }

  /**
   * Requests the pieces of the input once, in order, writes them to a container in the scratch
   * folder and solves on it, with scratch files beside it. Does not throw: the summary reports an
   * error, and there is then no solution.
   */
  void solve(PieceInput& input, JobTask& task, const PieceReading& reading, Progress& progress);

  /** The same on a .vsm file, which is only read. `fingerprint`: unless empty, that which it must
   * have. */
  void solveFile(const std::filesystem::path& file, const std::string& fingerprint, JobTask& task,
    const PieceReading& reading, Progress& progress);

  /**
   * The same on a whole ordinary mesh (see lacksStreamNumbering()): it is converted as a file is,
   * so that polygons, strips and hexahedra become triangles and tetrahedra, and points of no cell
   * are left out.
   */
  void solveWhole(
    vtkPointSet& mesh, JobTask& task, const PieceReading& reading, Progress& progress);

  /** Of a solution on an ordinary mesh: the values at all its points; not a number where no cell
   * is. */
  std::vector<double> valuesOfPoints();

  /** The solution; nullptr before a successful solve. */
  Solution* solution() const { return this->Result.get(); }

  /** Marks the solve as failed. */
  void fail(const std::string& sentence);

  const SolveSummary& summary() const { return this->Summary; }

private:
  void release();
  void discard();
  /** Makes the .vsm file of the mesh in the scratch folder; the report gets notes. */
  using MakeMesh =
    std::function<void(const std::filesystem::path& container, Progress& progress, Report& notes)>;
  using MakeFolder = std::function<std::unique_ptr<ScratchFolder>()>;
  void solveOn(const MakeFolder& folder, const MakeMesh& make, JobTask& task, Progress& progress);
  Report solveOnFile(const VsmReader& mesh, JobTask& task, const ProgressFunction& progress);
  ConversionReport writeWhole(vtkPointSet& mesh, const PieceReading& reading,
    const std::filesystem::path& container, Progress& progress);

  std::unique_ptr<ScratchFolder> Scratch; ///< of the solution
  std::unique_ptr<Solution> Result;
  std::vector<std::int64_t> VertexOfPoint; ///< of an ordinary mesh; -1: it has none
  InputStamp MadeFor;
  SolveSummary Summary;
};

} // namespace smg
