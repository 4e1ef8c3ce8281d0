// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** What a solve did and needed. The same in C++, on the command line and in VTK field data. */
struct SMG_EXPORT Report
{
  struct Level
  {
    std::int64_t nodes = 0;    ///< unknowns of the level
    std::int64_t nonzeros = 0; ///< entries of its matrix, the diagonal included
  };
  struct Seconds
  {
    double convert = 0, build = 0, solve = 0, coarse = 0, io_wait = 0, total = 0;
    double build_io_wait = 0; ///< the part of io_wait that is in build; threads count each
  };

  /** The traffic of the scratch files of one kind, of a level or (level -1) of none. */
  struct Traffic
  {
    /** rows, right_side (finest level), state, history (of accelerated V-cycles), labels, rest
     * (deformation) */
    std::string kind;
    int level = -1;
    std::int64_t read = 0, written = 0;
  };

  /** One of the problems of a solve that has several, one after the other. */
  struct Step
  {
    std::string name;
    int cycles = 0;
    /** Of the last V-cycle: ||b - A x|| / ||b - A x_0||, of this step's b. */
    double residual = 0;
    bool converged = false;
  };

  /** A Dirichlet, flux or Robin condition, by what the solution makes of it. */
  struct Condition
  {
    std::string name; ///< "dirichlet[0]", by the problem's numbers
    /** Of a Dirichlet condition: those that it holds; else 0. */
    std::int64_t vertices = 0;
    /** Length (of a surface's open edges) or area of its boundary facets; of a Dirichlet condition
     * those whose corners all have it. */
    double area = 0;
    /** Per column: the mean of u over the facets; without any over the vertices of a Dirichlet
     * condition, else not a number. */
    std::vector<double> mean;
    /** Per column: the total of (K grad u - q) . n, into the body. Of a Dirichlet condition the
     * reaction of its vertices, so that all fluxes balance. */
    std::vector<double> flux;
  };

  /** A value and the stream index of the first vertex that has it. */
  struct Extreme
  {
    double value = 0;
    std::int64_t vertex = -1;
  };

  std::int64_t vertices = 0, cells = 0;
  std::vector<Level> levels;
  int passes = 0, cycles = 0;
  /**
   * ||b - A x_k|| / ||b - A x_0|| after cycle k = 1, 2, ...; x_0 the initial values. Of a solve
   * with several steps, those of all steps in order.
   */
  std::vector<double> residuals;
  /** How V-cycles were accelerated: "none", "chebyshev" or "cg"; see AccelerationKind. */
  std::string acceleration = "none";
  /** The steps of a deformation: rotation and position. Empty for a solve of one problem. */
  std::vector<Step> steps;
  bool converged = false;      ///< of a solve with several steps: all of them
  std::int64_t peak_nodes = 0; ///< most nodes of all levels in memory at once
  std::int64_t pool_bytes_peak = 0, rss_bytes_peak = 0;
  std::int64_t bytes_read = 0, bytes_written = 0;
  std::vector<Traffic> bytes_by_kind; ///< what bytes_read and bytes_written are the sums of
  Seconds seconds;
  double cpu_seconds = 0;
  int threads = 1;
  std::int64_t prescribed = 0;       ///< constrained vertices
  std::int64_t shared = 0;           ///< vertices that more than one handle holds
  std::int64_t held = 0;             ///< vertices without a weighted cell: they keep their value
  std::int64_t degenerate_cells = 0; ///< cells without weight
  std::int64_t clamped_weights = 0;  ///< edges whose weight was raised to the floor
  /** Connected components, and how many of them have no constrained vertex. */
  std::int64_t components = 0, free_components = 0;
  /** Per column: what the mean of the sources of components without constraint, which was taken
   * from them, sums to; empty if nothing was. */
  std::vector<double> removed_source;
  /** What ProblemResults makes of the solution; all of these are empty without it. */
  std::vector<Condition> conditions;
  /** Per column: 1/2 the integral of grad u . K grad u + s u^2 over the piecewise linear u, s u^2
   * lumped at the vertices. */
  std::vector<double> energy;
  /** Per column: the mean of u, weighted with the lumped areas or volumes. */
  std::vector<double> mean;
  std::vector<Extreme> minimum, maximum; ///< per column
  /** Per column: the total of the sources f, less removed_source, and that of s u. */
  std::vector<double> source, screening;
  /** Per column: what the fluxes of all conditions and the sources bring and the screening does not
   * take, over the sum of the magnitudes of all that is summed; about the tolerance. */
  std::vector<double> balance;
  /** What a user should know: how free components were treated, why it did not converge ... */
  std::vector<std::string> notes;

  /** The last of the residuals; 0 if no V-cycle was needed. */
  double residual() const { return this->residuals.empty() ? 0.0 : this->residuals.back(); }

  /** As a JSON object with the names above. */
  std::string json(int indent = 2) const;
};

} // namespace smg
