// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/VsmReader.h"
#include "Solver/Results/ProblemResults.h"

#include <memory>
#include <string>
#include <vector>

namespace smg
{

/** Columns of solutions: of the vertices, then of the cells, if wanted. */
inline constexpr const char* SolutionName = "Solution";
inline constexpr const char* GradientName = "Gradient";
inline constexpr const char* FluxName = "Flux";

/**
 * The mesh stream of a .vsm file with all its columns and the solution of a problem on it: the
 * column Solution of the vertices and, if wanted, Gradient and Flux of the cells, 3 numbers for
 * each column of the problem. Those of an earlier solve are left out.
 */
class SolvedMesh : public MeshSource
{
public:
  /** All must live as long; `problem` is that of the solution. */
  SolvedMesh(
    const VsmReader& mesh, Problem& problem, Solution& solution, const ResultOptions& options = {});

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override;

  /** When the stream has been read to its end: what ProblemResults adds to the solution's report;
   * the vertices of minima and maxima have their numbers in the original file, if these are known.
   */
  void finish(Report& report);

private:
  std::unique_ptr<MeshSource> Source;
  ProblemResults Results;
  ResultOptions Options;
  StreamInfo Info;
  std::filesystem::path File;
};

} // namespace smg
