// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Results/CellResults.h"
#include "Solver/Jobs/Results/ConditionSums.h"
#include "Solver/Jobs/Results/VertexTerms.h"
#include "smg/Export.h"
#include "smg/Problem.h"
#include "smg/Report.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/** The sums over vertices, cells and facets from which the derived results of a report follow. */
class SMG_EXPORT ResultSums
{
public:
  ResultSums(CellType type, Problem& problem);

  /** Adds a vertex with its solution and its condition (-1: none). */
  void add(VertexTerms terms, const double* u, std::int32_t dirichlet);
  /** Sets the sums over the cells. */
  void setCells(const CellResults& cells);
  /** Compares a value of a column with the extremes; of equal ones the first one remains. */
  void compare(std::size_t column, double value, std::int64_t vertex)
  {
    Report::Extreme& least = this->minimum[column];
    Report::Extreme& most = this->maximum[column];
    least = value < least.value ? Report::Extreme{ value, vertex } : least;
    most = value > most.value ? Report::Extreme{ value, vertex } : most;
  }

  /** All sums: those of the parts of a mesh add up. */
  std::vector<double*> numbers();

  /** Sets conditions, energy, mean, minimum, maximum, source, screening and balance of the report
   * of the solution. Adds a note on the maximum difference from finite elements due to cells that
   * are too flat. */
  void finish(Report& report) const;

  ConditionSums conditions;
  std::vector<Report::Extreme> minimum, maximum; ///< per column

private:
  void addRobinTerms(VertexTerms terms, const double* u);
  void addDirichlet(VertexTerms terms, const double* u, std::int32_t dirichlet);
  void reportBalance(Report& report) const;
  static void noteConditionsWithoutEffect(Report& report);
  void noteFlatCells(Report& report) const;

  std::size_t Columns;
  bool HasFacets;
  std::vector<double> Reaction; // of a vertex
  double Mass = 0.0;
  // Per column.
  std::vector<double> Mean, Source, Screening, ScreeningEnergy, Magnitude;
  std::vector<double> CellEnergy, LeftOut; // see CellResults
  std::vector<double> ReactionTerms;       // magnitudes of the terms of the reactions
  // Terms of Robin conditions that the residual of the solve may contain, see commonShare().
  std::vector<double> RobinTerms;
};

} // namespace smg
