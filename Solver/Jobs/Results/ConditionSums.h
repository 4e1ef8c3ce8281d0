// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/BoundaryFacet.h"
#include "Solver/Assembly/OpenVertices.h"
#include "smg/Report.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/** Whether nothing determines these values of a vertex, which has no share in the equations. */
inline bool isUndetermined(const double* value)
{
  return std::isnan(value[0]);
}

/** Sums the data of Report::Condition over facets and vertices. */
class ConditionSums
{
public:
  ConditionSums(CellType type, const ConditionCounts& counts, int columns);

  /** Adds a boundary facet of this length or area; the values of `vertices` are the solution. */
  void add(const BoundaryFacet& facet, double area, const OpenVertices& vertices);
  /** Adds a vertex of a Dirichlet condition with its value and its reaction, `columns` numbers
   * each. */
  void add(std::int32_t dirichlet, const double* value, const double* reaction);

  std::vector<Report::Condition> conditions() const;
  /** Appends all sums: those of the parts of a mesh add up. */
  void appendNumbers(std::vector<double*>& numbers);
  /** Per column: the total inflow through all conditions, and the sum of the magnitudes. */
  const std::vector<double>& inflow() const { return this->Inflow; }
  const std::vector<double>& magnitude() const { return this->Magnitude; }
  /** Per column: the magnitudes of the terms whose differences are the Robin fluxes. */
  const std::vector<double>& robinTerms() const { return this->RobinTerms; }

private:
  struct Sums
  {
    double area = 0.0;
    std::vector<double> value, flux, vertexValue; ///< value: times area
    double vertices = 0.0;                        ///< their number
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
