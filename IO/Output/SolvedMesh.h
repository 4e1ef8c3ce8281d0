// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/VsmReader.h"
#include "Solver/Results/ProblemResults.h"

#include <memory>
#include <string>
#include <vector>

namespace smg
{

/** Names of the columns of solutions: of the vertices and, if requested, of the cells. */
inline constexpr const char* SolutionName = "Solution";
inline constexpr const char* GradientName = "Gradient";
inline constexpr const char* FluxName = "Flux";

/**
 * The mesh stream of a .vsm file with all its columns and the solution of a problem on it: the
 * column Solution of the vertices and, if requested, Gradient and Flux of the cells, 3 numbers per
 * column of the problem. These replace the columns of an earlier solve.
 */
class SolvedMesh : public MeshSource
{
public:
  /** All arguments must outlive the object; `problem` is that of the solution. */
  SolvedMesh(
    const VsmReader& mesh, Problem& problem, Solution& solution, const ResultOptions& options = {});

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override;

  /**
   * After the stream has been read: adds the results of ProblemResults to the report of the
   * solution; the vertices of minima and maxima have their indices in the original file, if known.
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
