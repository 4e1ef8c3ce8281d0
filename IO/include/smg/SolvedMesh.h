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

/** Names of the columns of solutions: of the vertices and, if requested, of the cells. */
inline constexpr const char* SolutionName = "Solution";
inline constexpr const char* GradientName = "Gradient";
inline constexpr const char* FluxName = "Flux";

/**
 * The mesh stream of a .vsm file with all its columns and the solution of a problem on it: the
 * column Solution of the vertices and, if requested, Gradient and Flux of the cells, 3 numbers per
 * column of the problem. These replace the columns of an earlier solve.
 */
class SMG_EXPORT SolvedMesh : public MeshSource
{
public:
  /** All arguments must outlive the object; `problem` is that of the solution. */
  SolvedMesh(
    const VsmReader& mesh, Problem& problem, Solution& solution, const ResultOptions& options = {});

  ~SolvedMesh() override;

  const StreamInfo& info() const override;
  bool next(MeshBlock& block) override;

  /**
   * After the stream has been read: adds the results of ProblemResults to the report of the
   * solution; the vertices of minima and maxima have their indices in the original file, if known.
   */
  void finish(Report& report);

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
