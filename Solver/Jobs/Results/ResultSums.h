// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Facets.h"
#include "Solver/Assembly/OpenVertices.h"
#include "smg/CellWeights.h"
#include "smg/Export.h"
#include "smg/Problem.h"
#include "smg/Report.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Integrals over the cells of a part. */
struct PartSums
{
  double measure = 0.0;
  std::vector<double> gradient, flux; ///< 3 * `columns` numbers
};

/** The gradients and fluxes of the cells of a block, and the sums over all cells. */
class CellResults
{
public:
  /** `gradient`, `flux`: whether they are requested. `parts`: see ConditionCounts. */
  CellResults(CellType type, int columns, bool gradient, bool flux, int parts);

  /** Starts the next block, of this many cells. */
  void begin(std::size_t cells);
  /** Adds cell c of the block: the positions of its corners, the values there (`columns` each), its
   * weights, the factor by which the solve scaled these down, K (null: the identity) and its part
   * (-1: none). */
  void add(std::size_t c, const double* const* points, const double* const* values,
    const CellWeights& weights, double flatness, const double* K, std::int32_t part);

  /** grad u in the block: 3 * `columns` numbers per cell, 0 in cells without measure. */
  std::span<const double> gradient() const { return this->Gradient; }
  /** -K grad u, likewise. */
  std::span<const double> flux() const { return this->Flux; }
  /** Per column: 1/2 the integral of grad u . K grad u, and the part of it that the solve has
   * omitted. */
  const std::vector<double>& energy() const { return this->Energy; }
  const std::vector<double>& leftOut() const { return this->LeftOut; }
  /** One of each part, and one of all other cells; empty without parts. */
  const std::vector<PartSums>& parts() const { return this->Parts; }

private:
  CellType Type;
  int Columns;
  bool WantsGradient, WantsFlux;
  std::vector<double> Gradient, Flux, Energy, LeftOut;
  std::vector<PartSums> Parts;
};

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
  /** Appends pointers to all sums, so that those of the parts of a mesh can be added up. */
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

  // Of column k:

  double& source(std::size_t k) { return this->at(k, 0); } ///< on the right-hand side
  double& inflow(std::size_t k) { return this->at(k, 1); } ///< on the right-hand side, by facets
  /** The flow along the edges of the vertex, of a Dirichlet vertex along those that lead out of the
   * condition; and, of the latter, the sum of the magnitudes of its terms. */
  double& outflow(std::size_t k) { return this->at(k, 2); }
  double& outflowTerms(std::size_t k) { return this->at(k, 3); }

private:
  static constexpr std::size_t OfColumns = 3;

  double& at(std::size_t k, std::size_t place) { return this->Numbers[OfColumns + 4 * k + place]; }

  double* Numbers;
};

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

  /** Pointers to all sums, so that those of the parts of a mesh can be added up. */
  std::vector<double*> numbers();

  /** Sets conditions, energy, mean, minimum, maximum, source, screening and balance of the report
   * of the solution. Adds a note on the maximum difference from finite elements due to cells that
   * are too flat. */
  void finish(Report& report) const;

  ConditionSums conditions;
  std::vector<Report::Extreme> minimum, maximum; ///< per column

private:
  /** What flows in a column, and how much of a flux the residual of the solution may be. */
  struct Flow
  {
    double all = 0.0;   ///< sum of the magnitudes of what flows in and out; 0: nothing does
    double least = 0.0; ///< what flows through the whole
    double doubt = 0.0; ///< of each flux
  };

  void addResidual(VertexTerms terms, const double* u, std::int32_t dirichlet);
  void reportBalance(Report& report) const;
  void reportParts(Report& report) const;
  Flow flowIn(const Report& report, std::size_t k) const;
  static bool markLost(Report& report, std::size_t k, const Flow& flow);
  static void noteConditionsWithoutEffect(Report& report);
  void noteFlatCells(Report& report) const;

  std::size_t Columns;
  std::vector<double> Residual; // of a vertex
  double Mass = 0.0;
  // Per column.
  std::vector<double> Mean, Source, Screening, ScreeningEnergy, Magnitude;
  std::vector<double> CellEnergy, LeftOut; // see CellResults
  std::vector<PartSums> Parts;             // likewise
  std::vector<double> ReactionTerms;       // magnitudes of the terms of the reactions
  // Of the residuals of vertices without a condition: the sum, and that of the squares.
  std::vector<double> ResidualSum, ResidualSquares;
};

} // namespace smg
