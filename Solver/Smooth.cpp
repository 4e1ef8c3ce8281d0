// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Smooth.h"

#include "Solver/Jobs/Fairing/MeshFairing.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Multigrid/Extended.h"

#include <cmath>
#include <string>

// The entry of smoothing: checks what can be checked without the mesh, before anything is read, and
// leaves the work to MeshFairing.

namespace smg
{

void checkOptions(const Smoothing& options)
{
  require(options.operators == Extended::name,
    "smoothing needs solutions, which the operator set " + options.operators +
      " does not give: use " + Extended::name);
  checkOptions(static_cast<const SolveOptions&>(options));
  refuseAutomaticTolerance(options, "smoothing");
  refuseCheckpoint(options, "smoothing has");
  // Whether the size fits the mesh is known after the first reading: MeshFairing::setSize().
  require(std::isfinite(options.size.value) && options.size.value > 0.0,
    "the size of the details to smooth (option --size) must be a positive number");
  require(
    options.steps >= 1 && options.steps <= 1000, "the number of steps must be from 1 to 1000");
  require(!options.keepEdges || (*options.keepEdges > 0.0 && *options.keepEdges < 180.0),
    "the angle of the edges to keep must lie between 0 and 180 degrees, both excluded");
  require(options.column.empty() || !options.keepEdges,
    "edges are kept when positions are smoothed: name no column, or keep no edges");
  require(options.column.empty() || !options.orient,
    "triangles are turned when positions are smoothed: name no column, or turn no triangles");
  // Curves are smoothed by moving their vertices, which a column does not do.
  require(options.column.empty() || options.boundary != SmoothedBoundary::Smooth,
    "the boundary is smoothed as curves only with the positions: of a column, fix it or leave it "
    "free");
}

std::unique_ptr<Solution> smooth(
  const StoredMesh& mesh, const SmoothingDescription& description, const SolveOptions& options)
{
  const Smoothing smoothing{ options, description };
  checkOptions(smoothing);
  // Everything that depends on the mesh, including its columns, is checked by the constructor and
  // the survey.
  return MeshFairing(mesh, smoothing).run();
}

} // namespace smg
