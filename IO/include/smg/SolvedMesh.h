// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Problem.h"
#include "smg/Report.h"
#include "smg/Solution.h"
#include "smg/VsmReader.h"

#include <memory>

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
class SMG_EXPORT SolvedMesh : public MeshSource
{
public:
  /** All must live as long; `problem` is that of the solution. */
  SolvedMesh(
    const VsmReader& mesh, Problem& problem, Solution& solution, const ResultOptions& options = {});

  ~SolvedMesh() override;

  const StreamInfo& info() const override;
  bool next(MeshBlock& block) override;

  /** When the stream has been read to its end: what ProblemResults adds to the solution's report;
   * the vertices of minima and maxima have their numbers in the original file, if these are known.
   */
  void finish(Report& report);

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
