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

/** Vertex column with the solution (float64): `columns` components. */
inline constexpr const char* SolutionName = "Solution";
/** Cell column with grad u (float64): 3 components for each column of the problem. */
inline constexpr const char* GradientName = "Gradient";
/** Cell column with -K grad u (float64): 3 components for each column of the problem. */
inline constexpr const char* FluxName = "Flux";

/**
 * The stream of a .vsm file with all its columns and the solution of a problem on it: the vertex
 * column Solution and, if wanted, the cell columns Gradient and Flux (0 in cells without weight; on
 * surfaces, in the plane of the triangle). Columns of these names from an earlier solve are left
 * out.
 */
class SMG_EXPORT SolvedMesh : public MeshSource
{
public:
  /**
   * Opens the stream. Mesh, problem and solution must outlive it.
   * @param mesh the mesh of the solution
   * @param problem the problem of the solution; asked once more while the stream is read
   * @param solution the solution
   * @param options which results to compute
   * @throws Error if the solution has another number of columns than the problem, or of vertices
   * than the mesh, or the problem has edge targets
   */
  SolvedMesh(
    const VsmReader& mesh, Problem& problem, Solution& solution, const ResultOptions& options = {});

  ~SolvedMesh() override;

  const StreamInfo& info() const override;
  bool next(MeshBlock& block) override;

  /**
   * Adds the results to a copy of the solution's report: `conditions`, `energy`, `mean`, `minimum`,
   * `maximum`, `source`, `screening`, `balance`, and notes. To be called when the stream has been
   * read to its end. The vertices of minima and maxima are original numbers if the mesh has the
   * column OriginalId.
   */
  void finish(Report& report);

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
