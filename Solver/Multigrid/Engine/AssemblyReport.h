// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Assembly.h"
#include "Solver/Multigrid/Engine/FreeComponents.h"
#include "smg/Export.h"
#include "smg/Report.h"

#include <cstdint>

namespace smg
{

/** What an assembly has counted. */
struct AssemblyCounts
{
  CellType type = CellType::Triangle;
  std::int64_t vertices = 0, cells = 0, prescribed = 0, held = 0;
  CellCounts ofCells;
  std::int64_t clampedWeights = 0, raisedRows = 0; ///< see Assembly
  std::int64_t components = 0, freeComponents = 0;
  double termSquares = 0.0;           ///< see InitialResidual
  bool anyTerm = false;               ///< see InitialResidual
  CoincidentPoints::Count coincident; ///< of different components; 0 where nobody looked
};

/** Adds the counts to the report. Throws Error if sums overflowed or vanished. */
SMG_EXPORT void reportAssembly(const AssemblyCounts& counts, Report& report);
/** The same for the counts of an assembly and its components. */
SMG_EXPORT void reportAssembly(
  const Assembly& assembly, const Components& components, Report& report);

/** Throws Error if the sum of the squares of the values (see InitialResidual) overflowed, or if it
 * vanished though there are values (`anyTerm`). */
SMG_EXPORT void checkSquares(double termSquares, bool anyTerm);

/** Adds notes and warnings on the data of reportAssembly(). To be called at the end of a solve,
 * when the steps of a deformation are in the report; `undetermined`: see FreeComponents. */
SMG_EXPORT void addAssemblyNotes(Report& report, UndeterminedValues undetermined);

} // namespace smg
