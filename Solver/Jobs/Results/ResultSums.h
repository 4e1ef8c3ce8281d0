// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Facets.h"
#include "Solver/Assembly/OpenVertices.h"
#include "Solver/Assembly/WeightedCells.h"
#include "Solver/Jobs/Results/BodyFlows.h"
#include "Solver/Jobs/Results/CellResults.h"
#include "smg/Export.h"
#include "smg/Problem.h"
#include "smg/Report.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
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

  /** Adds a boundary facet of this length or area, of the body of this label; the values of
   * `vertices` are the solution. */
  void add(
    const BoundaryFacet& facet, double area, const OpenVertices& vertices, std::int32_t label);
  /** Adds a vertex of a Dirichlet condition with its value and its reaction, `columns` numbers
   * each. */
  void add(std::int32_t dirichlet, const double* value, const double* reaction, std::int32_t label);

  std::vector<Report::Condition> conditions() const;
  /** The groups of a part; empty: none. */
  std::string groupOfPart(std::size_t part) const;
  /** Appends pointers to all sums, so that those of the parts of a mesh can be added up. */
  void appendNumbers(std::vector<double*>& numbers);
  /** Per column: the total inflow through all conditions. */
  const std::vector<double>& inflow() const { return this->Inflow; }

  BodyFlows bodies;

private:
  struct Sums
  {
    double area = 0.0;
    std::vector<double> value, flux, vertexValue; ///< value: times area
    double vertices = 0.0;                        ///< their number
  };

  void addMean(Sums& sums, const BoundaryFacet& facet, double area, const OpenVertices& vertices);
  void addFlux(Sums& sums, std::size_t column, double flux, std::int32_t label);
  void addRobin(
    const BoundaryFacet& facet, double area, const OpenVertices& vertices, std::int32_t label);
  /** The groups of a condition or part, by its place among all; empty: none. */
  std::string groupOf(std::size_t place) const;
  void append(const char* kind, const std::vector<Sums>& all,
    std::vector<Report::Condition>& conditions) const;

  int Corners; // of a facet
  std::size_t Columns;
  std::vector<Sums> Dirichlet, Flux, Robin;
  std::vector<double> Inflow;
  std::vector<std::string> Groups; ///< see ConditionCounts
};

/** What the cells, boundary facets and edges of a vertex contribute to the results. All of these
 * are sums, so that the terms of a vertex that lies in several parts of a mesh are added up. */
class VertexTerms
{
public:
  /** How many numbers a vertex has. */
  static std::size_t size(std::size_t columns) { return OfColumns + 4 * columns; }

  /** A view of this many numbers. */
  explicit VertexTerms(double* numbers)
    : Numbers(numbers)
  {
  }

  double& mass() { return this->Numbers[0]; }
  double& screening() { return this->Numbers[1]; } ///< its part of the diagonal
  double& transfer() { return this->Numbers[2]; }  ///< the part of Robin conditions in the diagonal
  double& weights() { return this->Numbers[3]; }   ///< sum of the magnitudes of those of its edges

  // Of column k:

  double& source(std::size_t k) { return this->at(k, 0); } ///< on the right-hand side
  double& inflow(std::size_t k) { return this->at(k, 1); } ///< on the right-hand side, by facets
  /** The flow along the edges of the vertex, of a Dirichlet vertex along those that lead out of the
   * condition; and, of the latter, the sum of the magnitudes of its terms. */
  double& outflow(std::size_t k) { return this->at(k, 2); }
  double& outflowTerms(std::size_t k) { return this->at(k, 3); }

private:
  static constexpr std::size_t OfColumns = 4;

  double& at(std::size_t k, std::size_t place) { return this->Numbers[OfColumns + 4 * k + place]; }

  double* Numbers;
};

/** The sums over vertices, cells and facets from which the derived results of a report follow. */
class SMG_EXPORT ResultSums
{
public:
  ResultSums(CellType type, Problem& problem);

  /** Adds a vertex with its solution, its condition (-1: none) and the label of its body. */
  void add(VertexTerms terms, const double* u, std::int32_t dirichlet, std::int32_t label);
  /** Sets the sums over the cells. */
  void setCells(const CellResults& cells);
  /** Adds what flows through a link, by column. */
  void addContact(const VertexCouplings::Link& link, std::span<const double> flow);
  /** Compares a value of a column with the extremes; of equal ones the first one remains. */
  void compare(std::size_t column, double value, std::int64_t vertex)
  {
    Report::Extreme& least = this->minimum[column];
    Report::Extreme& most = this->maximum[column];
    least = value < least.value ? Report::Extreme{ value, vertex } : least;
    most = value > most.value ? Report::Extreme{ value, vertex } : most;
  }

  /** Pointers to all sums, so that those of the parts of a mesh can be added up, and to the numbers
   * of which the least one is that of all. */
  struct Numbers
  {
    std::vector<double*> sums, least;
  };
  Numbers numbers();

  /** `hasRest`: whether the values of the solution have more digits than a double. Sets conditions,
   * energy, mean, minimum, maximum, source, screening and balance of the report of the solution.
   * Adds a note on the maximum difference from finite elements due to cells that are too flat. */
  void finish(Report& report, bool hasRest) const;

  ConditionSums conditions;
  std::vector<Report::Extreme> minimum, maximum; ///< per column

private:
  void addResidual(VertexTerms terms, const double* u, std::int32_t dirichlet, std::int32_t label);
  void reportBalance(Report& report, bool hasRest) const;
  void reportParts(Report& report) const;
  void reportIntegrals(Report& report) const;
  static void noteConditionsWithoutEffect(Report& report);
  void noteFlatCells(Report& report) const;

  std::size_t Columns;
  std::vector<double> Residual; // of a vertex
  double Mass = 0.0;
  // Per column.
  std::vector<double> Mean, Source, Screening, ScreeningEnergy;
  std::vector<double> CellEnergy, LeftOut; // see CellResults
  std::vector<PartSums> Parts;             // likewise
  std::vector<IntegralSums> Integrals;     // likewise
  std::vector<std::string> IntegralNames;
  std::vector<VertexCouplings::Contact> Contacts;
  std::vector<Report::Contact> OfContacts; // with sums of magnitudes, before they are means
};

} // namespace smg
