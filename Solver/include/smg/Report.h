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
    std::int64_t nonzeros = 0; ///< entries of its matrix, including the diagonal
  };
  struct Seconds
  {
    double convert = 0, build = 0, solve = 0, coarse = 0, io_wait = 0, total = 0;
    double build_io_wait = 0; ///< the part of io_wait in build, summed over threads
  };

  /** The traffic of the scratch files of one kind, for a level or (-1) for no level. */
  struct Traffic
  {
    /** rows, right_side (finest level), state, history (of accelerated V-cycles), labels, rest
     * (deformation) */
    std::string kind;
    int level = -1;
    std::int64_t read = 0, written = 0;
  };

  /** One of several successive problems of a solve. */
  struct Step
  {
    std::string name;
    int cycles = 0;
    /** ||b - A x|| / ||b - A x_0|| after the last V-cycle, for b of this step. */
    double residual = 0;
    bool converged = false;
  };

  /** The results of a Dirichlet, flux or Robin condition. */
  struct Condition
  {
    std::string name; ///< for example "dirichlet[0]", by the index in the problem
    /** The vertices that a Dirichlet condition prescribes; otherwise 0. */
    std::int64_t vertices = 0;
    /** Length (of open edges of a surface) or area of its boundary facets; for a Dirichlet
     * condition, of those with all corners prescribed. */
    double area = 0;
    /** Per column: the mean of u over the facets; without facets, over the vertices of a Dirichlet
     * condition, else NaN. */
    std::vector<double> mean;
    /** Per column: the total of (K grad u - q) . n, into the body. For a Dirichlet condition the
     * reaction of its vertices, so that all fluxes balance. */
    std::vector<double> flux;
  };

  /** A value and the stream index of the first vertex with it. */
  struct Extreme
  {
    double value = 0;
    std::int64_t vertex = -1;
  };

  std::int64_t vertices = 0, cells = 0;
  std::vector<Level> levels;
  int passes = 0, cycles = 0;
  /** ||b - A x_k|| / ||b - A x_0|| after cycle k = 1, 2, ..., with the initial values x_0. For a
   * solve with several steps, those of all steps in order. */
  std::vector<double> residuals;
  /** The acceleration used: "none", "chebyshev" or "cg"; see AccelerationKind. */
  std::string acceleration = "none";
  /** The steps of a deformation: rotation and position. Empty for a solve of one problem. */
  std::vector<Step> steps;
  bool converged = false;      ///< of all steps
  std::int64_t peak_nodes = 0; ///< maximum of nodes of all levels in memory at once
  std::int64_t pool_bytes_peak = 0, rss_bytes_peak = 0;
  std::int64_t bytes_read = 0, bytes_written = 0;
  std::vector<Traffic> bytes_by_kind; ///< the parts of bytes_read and bytes_written
  Seconds seconds;
  double cpu_seconds = 0;
  int threads = 1;
  std::int64_t prescribed = 0;       ///< constrained vertices
  std::int64_t shared = 0;           ///< vertices that more than one handle holds
  std::int64_t held = 0;             ///< vertices without a weighted cell: they keep their value
  std::int64_t degenerate_cells = 0; ///< cells without weight
  std::int64_t clamped_weights = 0;  ///< edges with a weight raised to the floor
  /** The number of connected components, and of those without constrained vertices. */
  std::int64_t components = 0, free_components = 0;
  /** Per column: the total source subtracted from unconstrained components as the mean; empty if
   * none was. */
  std::vector<double> removed_source;
  /** The results of ProblemResults; this and the following are empty without it. */
  std::vector<Condition> conditions;
  /** Per column: 1/2 the integral of grad u . K grad u + s u^2 for the piecewise linear u, with s
   * u^2 lumped at the vertices. */
  std::vector<double> energy;
  /** Per column: the mean of u, weighted by the lumped areas or volumes. */
  std::vector<double> mean;
  std::vector<Extreme> minimum, maximum; ///< per column
  /** Per column: the total of the sources f minus removed_source, and that of s u. */
  std::vector<double> source, screening;
  /** Per column: the sum of the fluxes of all conditions and the sources minus the screening, over
   * the sum of their magnitudes; about the tolerance. */
  std::vector<double> balance;
  /** Notes for the user: the treatment of free components, the reason of missing convergence ... */
  std::vector<std::string> notes;

  /** The last of the residuals; 0 if no V-cycle was needed. */
  double residual() const { return this->residuals.empty() ? 0.0 : this->residuals.back(); }

  /** As a JSON object with the names above. */
  std::string json(int indent = 2) const;
};

} // namespace smg
