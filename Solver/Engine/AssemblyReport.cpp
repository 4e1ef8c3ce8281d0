// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Engine/AssemblyReport.h"

#include "Solver/Engine/Convergence.h"
#include "smg/Error.h"

#include <cmath>
#include <string>

namespace smg
{

void reportAssembly(const Assembly& assembly, const Components& components, Report& report)
{
  report.vertices = assembly.vertices();
  report.cells = assembly.cells();
  report.prescribed = assembly.prescribed();
  report.held = assembly.held();
  report.degenerate_cells = assembly.weights().degenerateCells();
  report.clamped_weights = assembly.clampedWeights();
  if (assembly.weights().limitedCells() > 0)
  {
    report.notes.push_back(std::to_string(assembly.weights().limitedCells()) +
                           " cells are so flat that rounding would drown the others: their "
                           "stiffness was scaled down, by a factor of " +
                           scientific(assembly.weights().leastFlatness()) +
                           " at the least; there the operator is not that of finite elements");
  }
  if (assembly.raisedRows() > 0)
  {
    report.notes.push_back(std::to_string(assembly.raisedRows()) +
                           " vertices have weights whose sum is lost in rounding: 1e-8 of "
                           "their magnitudes holds them near their initial values; there the "
                           "operator is not that of finite elements");
  }
  report.components = components.components();
  report.free_components = components.freeComponents();
  if (!std::isfinite(assembly.residual().termSquares()))
  {
    throw Error("the squares of the values overflow: scale the mesh, the prescribed values, the "
                "sources or the screening");
  }
}

void addAssemblyNotes(Report& report)
{
  if (report.clamped_weights > 0)
  {
    report.notes.push_back(
      std::to_string(report.clamped_weights) +
      " weights were below the floor and were raised to it: there the operator is "
      "not that of finite elements");
  }
  if (report.held > 0)
  {
    report.notes.push_back(std::to_string(report.held) +
                           " vertices belong to no cell that has a weight: they stay as they are");
  }
}

} // namespace smg
