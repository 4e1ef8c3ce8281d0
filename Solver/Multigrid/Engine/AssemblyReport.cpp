// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/AssemblyReport.h"

#include "Solver/Core/Text.h"
#include "Solver/Mesh/StreamCheck.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "smg/Error.h"

#include <cmath>
#include <string>

// Puts what the assembly counted into the report, and says in words where the operator is not that
// of finite elements, or where nothing determines a value: the user cannot see these in the result.
// A note is for information; a warning says that the result may not be what was meant. The engine
// on several processes uses the same functions with its own counts.

namespace smg
{

namespace
{

/** Bodies that only look connected. Where most cells are bodies, noteUnwelded() has said so. */
void warnOfCoincidentPoints(const AssemblyCounts& counts, Report& report)
{
  if (counts.coincident.places == 0 ||
      !unweldedNote(counts.type, counts.vertices, counts.cells).empty())
  {
    return;
  }
  const std::string number = std::to_string(counts.coincident.places);
  report.warn("points of different bodies coincide at " +
              (counts.coincident.isExact ? number : "about " + number) +
              (counts.coincident.places == 1 ? " place" : " places") + " (the mesh has " +
              std::to_string(counts.components) +
              " bodies): the bodies are not connected there, and nothing flows from one to the "
              "other, unless these points are merged " +
              HowToWeld);
}

/** Of a defect of `part` of all cells or vertices: from one in a hundred on, the solution may be
 * another altogether. */
void noteOfPart(std::int64_t part, std::int64_t all, const std::string& sentence, Report& report)
{
  if (part >= all / 100)
  {
    report.warn(sentence);
    return;
  }
  report.notes.push_back(sentence);
}

} // namespace

void reportAssembly(const AssemblyCounts& counts, Report& report)
{
  report.vertices = counts.vertices;
  report.cells = counts.cells;
  report.prescribed = counts.prescribed;
  report.held = counts.held;
  report.degenerate_cells = counts.ofCells.degenerate;
  report.coincident_cells = counts.ofCells.coincident;
  report.clamped_weights = counts.clampedWeights;
  noteUnwelded(counts.type, counts.vertices, counts.cells, report);
  if (counts.ofCells.limited > 0)
  {
    noteOfPart(counts.ofCells.limited, counts.cells,
      counted(counts.ofCells.limited, "cell is", "cells are") +
        " so flat that rounding would drown the others: their "
        "stiffness was scaled down, by a factor of " +
        scientific(counts.ofCells.minFlatness) +
        " at the least; there the operator is not that of finite elements",
      report);
  }
  if (counts.raisedRows > 0)
  {
    noteOfPart(counts.raisedRows, counts.vertices,
      counted(counts.raisedRows, "vertex has", "vertices have") +
        " weights whose sum is lost in rounding: 1e-8 of "
        "their magnitudes holds them near their initial values; there the "
        "operator is not that of finite elements",
      report);
  }
  report.components = counts.components;
  report.free_components = counts.freeComponents;
  warnOfCoincidentPoints(counts, report);
  counts.ofCells.measures.check(counts.type);
  checkSquares(counts.termSquares, counts.anyTerm);
}

/** Before any V-cycle. The norm of the residual would be infinite, and no tolerance could be met;
 * or 0, and any values would meet it. */
void checkSquares(double termSquares, bool anyTerm)
{
  // Of values of 1e-142: the squares of residuals down to their rounding are normal numbers, or
  // nearly.
  constexpr double Least = 1e-284;
  if (anyTerm && termSquares < Least)
  {
    throw Error("the values are so small, below about 1e-142, that their squares vanish: scale the "
                "prescribed values, the sources, the fluxes or the mesh");
  }
  if (!std::isfinite(termSquares))
  {
    throw Error("the squares of the values overflow: scale the mesh, the prescribed values, the "
                "sources or the screening");
  }
}

void reportAssembly(const Assembly& assembly, const Components& components, Report& report)
{
  AssemblyCounts counts;
  counts.type = assembly.cellType();
  counts.vertices = assembly.vertices();
  counts.cells = assembly.cells();
  counts.prescribed = assembly.prescribed();
  counts.held = assembly.held();
  counts.ofCells = assembly.cellCounts();
  counts.clampedWeights = assembly.clampedWeights();
  counts.raisedRows = assembly.raisedRows();
  counts.components = components.components();
  counts.freeComponents = components.freeComponents();
  counts.termSquares = assembly.residual().termSquares();
  // The residual that is to be corrected may be as small as it likes.
  counts.anyTerm = !assembly.corrects() && assembly.residual().anyTerm();
  // A single body needs no search.
  counts.coincident =
    counts.components > 1 ? assembly.coincident().count(components) : CoincidentPoints::Count();
  reportAssembly(counts, report);
}

void addAssemblyNotes(Report& report, UndeterminedValues undetermined)
{
  // A deformation, whose steps are in the report by now, raises weights by default and uses the
  // operator only as a measure of details.
  if (report.clamped_weights > 0 && report.steps.empty())
  {
    report.notes.push_back(
      std::to_string(report.clamped_weights) +
      " weights were below the floor and were raised to it: there the operator is "
      "not that of finite elements");
  }
  if (report.coincident_cells > 0)
  {
    report.warn(std::to_string(report.coincident_cells) +
                (report.coincident_cells == 1 ? " cell without area or volume joins"
                                              : " cells without area or volume join") +
                " coincident points, as a clip through points of a mesh leaves them: the mesh is "
                "open there, unless these are merged " +
                HowToWeld);
  }
  if (report.held > 0)
  {
    const std::string values = undetermined == UndeterminedValues::NotNumbers ? "are not numbers"
                               : undetermined == UndeterminedValues::RightSide
                                 ? "are those of the right-hand side"
                                 : "stay as they were";
    report.warn(
      std::to_string(report.held) + (report.held == 1 ? " vertex belongs" : " vertices belong") +
      " to no cell that has a weight, so that nothing determines the values there: they " + values);
  }
}

} // namespace smg
