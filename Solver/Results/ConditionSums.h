// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/BoundaryFacet.h"
#include "Solver/Problem/OpenVertices.h"
#include "smg/Report.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/** Sums what Report::Condition tells over facets and vertices. */
class ConditionSums
{
public:
  ConditionSums(CellType type, const ConditionCounts& counts, int columns);

  /** A boundary facet of this length or area; `vertices` have the solution as their values. */
  void add(const BoundaryFacet& facet, double area, const OpenVertices& vertices);
  /** A vertex of a Dirichlet condition with its value and its reaction, `columns` numbers each. */
  void add(std::int32_t dirichlet, const double* value, const double* reaction);

  std::vector<Report::Condition> conditions() const;
  /** Per column: what flows in through all of them, and the sum of the magnitudes of that. */
  const std::vector<double>& inflow() const { return this->Inflow; }
  const std::vector<double>& magnitude() const { return this->Magnitude; }
  /** Per column: the magnitudes of what Robin fluxes are the differences of. */
  const std::vector<double>& robinTerms() const { return this->RobinTerms; }

private:
  struct Sums
  {
    double area = 0.0;
    std::vector<double> value, flux, vertexValue; ///< value: times area
    std::int64_t vertices = 0;
  };

  void addMean(Sums& sums, const BoundaryFacet& facet, double area, const OpenVertices& vertices);
  void addFlux(Sums& sums, std::size_t column, double flux);
  void append(const char* kind, const std::vector<Sums>& all,
    std::vector<Report::Condition>& conditions) const;

  int Corners; // of a facet
  std::size_t Columns;
  std::vector<Sums> Dirichlet, Flux, Robin;
  std::vector<double> Inflow, Magnitude, RobinTerms;
};

} // namespace smg
