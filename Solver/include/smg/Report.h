// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace smg
{

/**
 * What a solve did and what it cost. It has the same entries in C++, on the command line and in VTK
 * field data. The results from `conditions` to `balance` are set by SolvedMesh::finish() and empty
 * without it.
 */
struct SMG_EXPORT Report
{
  /** A level of the hierarchy. */
  struct Level
  {
    std::int64_t nodes = 0;    ///< unknowns
    std::int64_t nonzeros = 0; ///< entries of the matrix, including the diagonal
    /** The nodes whose unknowns had room in memory at once; all of a level in core. 0: not known.
     */
    std::int64_t window = 0;
  };
  /** An operation on the nodes of a level, in all passes of a kind: see docs/architecture.md. */
  struct Stage
  {
    std::string name;   ///< what it does
    int level = 0;      ///< of the hierarchy; 0: the mesh
    bool first = false; ///< of the first pass, which builds the hierarchy
    double seconds = 0; ///< of the threads that ran it, without waiting for others
  };
  /** Wall-clock times, seconds. */
  struct Seconds
  {
    double convert = 0; ///< before the solve: conversion or transfer of the mesh, set by the caller
    double build = 0;   ///< first pass: assembly and hierarchy
    double solve = 0;   ///< all further passes
    double coarse = 0;  ///< the part of build and solve that is spent on the levels in memory
    double io_wait = 0; ///< waits for scratch files; threads that wait at the same time count each
    double total = 0;   ///< from the start to the end, including `convert`
    double build_io_wait = 0; ///< the part of io_wait that is in build
  };

  /** Traffic of the scratch files of a kind. */
  struct Traffic
  {
    /** rows, right_side (finest level), state, history (of accelerated V-cycles), labels, rest
     * (deformation), smoothed (values between the steps of smoothing), or original (values before
     * a blend). */
    std::string kind;
    int level = -1;           ///< level of the files, 0: the finest; -1: of no level
    std::int64_t read = 0;    ///< bytes
    std::int64_t written = 0; ///< bytes
  };

  /** What a pass over the mesh cost. */
  struct Pass
  {
    /** ||b - A x|| / ||b - A x_0|| of the step that the pass belongs to, after the first pass that
     * of the initial values; of a distance the share of the vertices that have changes to pass on,
     * or of the walls that are to come. */
    double residual = 1;
    double seconds = 0;          ///< wall-clock time of the pass
    std::int64_t read = 0;       ///< bytes read from scratch files
    std::int64_t written = 0;    ///< bytes written to scratch files
    std::int64_t pool_bytes = 0; ///< most accounted memory at once until its end, bytes
  };

  /** One of several problems that are solved one after the other. */
  struct Step
  {
    std::string name; ///< "rotation" or "position"; of smoothing "step 1", "presmoothing 1" ...
    int cycles = 0;   ///< V-cycles
    /** ||b - A x|| / ||b - A x_0|| of this step after its last V-cycle; 0 if it needed none. With
     * several processes the largest one of the right-hand sides. */
    double residual = 0;
    bool converged = false; ///< as Report::converged
  };

  /** The volume that a surface encloses. */
  struct Volume
  {
    double before = 0; ///< of the given mesh; NaN if it has a boundary
    double after = 0;  ///< of the smoothed mesh; NaN if it has a boundary
    /** Volume that the surface has swept, positive where it moved along its normals. */
    double swept = 0;
  };

  /** A shortest path from a source to a vertex. */
  struct Path
  {
    std::int64_t to = -1;   ///< the number of the vertex in the original file, or in the stream
    std::int64_t from = -1; ///< that of the source; -1: none reaches the vertex
    double length = 0;      ///< in the unit of the mesh; infinite if none reaches the vertex
    /** The corners of a polyline on the surface, from the source on. Empty if no source reaches the
     * vertex. */
    std::vector<std::array<double, 3>> points;
  };

  /** What a distance found. */
  struct Distance
  {
    std::int64_t sources = 0;   ///< source vertices, or wall triangles
    std::int64_t unreached = 0; ///< vertices whose distance is infinite
    /** Vertices that had changes to pass on when the last pass ended: 0 unless it was the last one
     * allowed. */
    std::int64_t unsettled = 0;
    bool exact = false; ///< up to rounding, if the passes were not ended
    /** How often the passes read the mesh, the parts of it that they skip left out. */
    double mesh_readings = 0;
    double maximum = 0; ///< of the distances that are finite
    double mean = 0;    ///< of the vertices whose distance is finite
    /** To the vertices that DistanceDescription::to selects, in the order of their numbers. */
    std::vector<Path> paths;
  };

  /** The cells with a tag, and their areas or volumes together. */
  struct Area
  {
    double tag;         ///< of the cells
    std::int64_t cells; ///< that count
    double area;        ///< or volume
  };

  /** Areas of a surface, or volumes. */
  struct Areas
  {
    bool isVolume = false;    ///< of tetrahedra
    std::int64_t cells = 0;   ///< that count
    double total = 0;         ///< of these
    bool hasTags = false;     ///< whether sums by tags were asked for
    std::vector<Area> by_tag; ///< by ascending tags
  };

  /** The cells that a deformation inverts, in the precision of the deformed mesh: tetrahedra whose
   * volume changes its sign or vanishes. A triangle in space has no sign: of a surface those that
   * collapse, whose smallest stretch is at most 1e-3 of their largest (as singular values of the
   * linear map). Cells without weight or flat at rest do not count. */
  struct Inverted
  {
    std::int64_t cells = 0; ///< number of these
    double share = 0;       ///< part of all cells, 0 to 1
    /** The first cell with the smallest ratio, by its original number if that is known, else its
     * index in the stream; -1: none. */
    std::int64_t worst = -1;
    /** Of this cell: its volume over that at rest, at most 0; of a triangle the smallest over the
     * largest stretch. */
    double ratio = 0;
    std::array<double, 3> place{}; ///< its centre in the deformed mesh
  };

  /** The errors of a solution in the energy norm, estimated: the root of the integral of
   * grad e . K grad e, of all columns together. */
  struct Errors
  {
    /** Against the solution of the equations on the mesh; with the screening and the heat transfer
     * of these, too. */
    double algebraic = 0;
    double discretisation = 0; ///< of that against the solution of the continuous problem
    double energy_norm = 0;    ///< of the solution itself
  };

  /** What a solve on several processes took. */
  struct Distributed
  {
    int processes = 1;                         ///< number of these
    int setups = 0;                            ///< hierarchies of preconditioners that were built
    std::vector<int> iterations;               ///< of each right-hand side
    std::vector<std::int64_t> pool_bytes_peak; ///< of each process: see Report
    std::vector<std::int64_t> rss_bytes_peak;  ///< of each process: see Report
  };

  /** A Dirichlet, flux or Robin condition and what the solution makes of it. */
  struct Condition
  {
    /** "dirichlet[0]", "flux[0]" or "robin[0]", with its number in the problem; of a group with its
     * name, as "robin[0] (outlet)". */
    std::string name;
    std::int64_t vertices = 0; ///< of a Dirichlet condition: vertices it prescribes; else 0
    /** Length (of open edges of a surface) or area of its boundary facets; of a Dirichlet condition
     * those whose corners it all prescribes. Without the shares of undetermined vertices. */
    double area = 0;
    /** Per column: the mean of u over these facets; without any the mean over the vertices of a
     * Dirichlet condition, and NaN for other conditions. */
    std::vector<double> mean;
    /** Per column: the total of (K grad u - q) . n, positive into the body. Of a Dirichlet
     * condition the reaction of its vertices, so that all fluxes balance. NaN, with a warning, if
     * the residual that the solution leaves may be a tenth of it. */
    std::vector<double> flux;
  };

  /** A part of the mesh, and the means of the solution over it: where K is a number, the mean of
   * the flux is -K times that of the gradient; of the whole the ratio is an effective conductivity.
   */
  struct Part
  {
    /** "conductivity[0]" with the number of its entry in the problem and its group, as of a
     * condition; "elsewhere", where none holds, or "all". */
    std::string name;
    double measure = 0;           ///< area or volume of its cells
    std::vector<double> gradient; ///< mean of grad u: 3 a column
    std::vector<double> flux;     ///< mean of -K grad u: 3 a column
  };

  /** The solution over a group of cells, or over the whole. */
  struct Integral
  {
    std::string name;             ///< of the group, or its number; "all"
    double measure = 0;           ///< area or volume of its cells
    std::vector<double> integral; ///< per column: of u
    std::vector<double> mean;     ///< per column: of u; NaN if it has no area or volume
    std::vector<double> gradient; ///< integral of grad u: 3 a column
    std::vector<double> flux;     ///< integral of -K grad u: 3 a column
  };

  /** What flows through a contact of bodies (ProblemDescription::interfaces). */
  struct Contact
  {
    std::string name;         ///< "interface[0]", with the name of its group
    double area = 0;          ///< or length, of a surface
    std::vector<double> step; ///< per column: the mean of |u - u on the other side|
    std::vector<double> flow; ///< per column: the total of coefficient * |u - u on the other side|
  };

  /** The largest difference of a column, over its components, between the ends of the edges that
   * are not in one patch. */
  struct Seam
  {
    std::string column; ///< its name
    double before = 0;  ///< in the original values
    double after = 0;   ///< in the blended values, not rounded to the type of the column
  };

  /** An extreme value. */
  struct Extreme
  {
    double value = 0; ///< of u
    /** The first vertex that has it, by its stream index or, after SolvedMesh::finish(), its
     * original number if that is known; -1 if no value is a number. */
    std::int64_t vertex = -1;
  };

  std::int64_t vertices = 0; ///< of the mesh
  std::int64_t cells = 0;    ///< of the mesh
  std::vector<Level> levels; ///< from the finest to the coarsest
  int passes = 0;            ///< passes over the mesh
  /** Of these, the passes of earlier programs whose checkpoint this one continued; 0: none. Of the
   * times, `total` is that of the last program alone. */
  int resumed_passes = 0;
  int cycles = 0; ///< V-cycles, of all steps
  /** ||b - A x_k|| / ||b - A y|| after V-cycle k = 1, 2, ..., with y = relative_to; of several
   * steps one after the other. */
  std::vector<double> residuals;
  /** "the best constant" of each column and component of the mesh, or "the mesh at rest"; empty
   * without V-cycles. */
  std::string relative_to;
  /** The passes in which V-cycles, or the marches of a distance, were done, one after the other;
   * with several processes: empty. */
  std::vector<Pass> by_pass;
  std::vector<Stage> stages; ///< of the streaming engine, in the order of the stream
  /** The acceleration used: "none", "chebyshev" or "cg"; see AccelerationKind. */
  std::string acceleration = "none";
  std::vector<Step> steps;      ///< of a deformation or of smoothing; else empty
  std::optional<Volume> volume; ///< if positions are smoothed
  /** Whether the solve, or all of its steps, reached the tolerance or the limit of rounding, or did
   * the fixed number of V-cycles (DeformOptions::cycles). */
  bool converged = false;
  std::int64_t peak_nodes = 0;      ///< most nodes of all levels in memory at once
  std::int64_t pool_bytes_peak = 0; ///< most accounted memory at once, bytes
  std::int64_t rss_bytes_peak = 0;  ///< largest resident memory of the process, bytes; 0: not known
  /** Most bytes of scratch files at once; of a command, with its conversion and its writing. */
  std::int64_t scratch_bytes_peak = 0;
  std::int64_t bytes_read = 0;        ///< read from scratch files
  std::int64_t bytes_written = 0;     ///< written to scratch files
  std::vector<Traffic> bytes_by_kind; ///< the terms that bytes_read and bytes_written sum up
  Seconds seconds;                    ///< wall-clock times
  double cpu_seconds = 0;             ///< processor time of all threads of the process
  int threads = 1;                    ///< compute threads
  std::int64_t prescribed = 0;        ///< vertices with a Dirichlet value, or held by a handle
  std::int64_t shared = 0;            ///< of a deformation: vertices that several handles hold
  /** Vertices that nothing determines, since no cell there has a weight: a solution is NaN there,
   * what is smoothed, moved or blended stays. */
  std::int64_t held = 0;
  std::int64_t degenerate_cells = 0; ///< cells without weight
  /** Of these, cells of which corners coincide: the mesh is open there, unless they are merged. */
  std::int64_t coincident_cells = 0;
  std::int64_t clamped_weights = 0; ///< edges whose weight was raised to the floor
  std::int64_t components = 0;      ///< connected components of the mesh
  /** Components without any prescribed vertex, screening, soft constraint or Robin condition. */
  std::int64_t free_components = 0;
  /** Per column: the total that was taken from the sources of free components, so that their mean
   * is 0; empty if nothing was. */
  std::vector<double> removed_source;
  std::vector<Seam> seams; ///< of a blend: one for each column; else empty
  /** Of a blend or a smoothed column: values that become the smallest or largest number of the
   * integer type of their column, since they are beyond it. */
  std::int64_t clipped = 0;
  std::optional<Errors> errors;      ///< with SolveOptions::AutomaticTolerance; else none
  std::vector<Condition> conditions; ///< of the problem: Dirichlet, flux, then Robin
  /** Per column: 1/2 the integral of grad u . K grad u + s u^2 over the piecewise linear u, s u^2
   * lumped at the vertices. */
  std::vector<double> energy;
  /** Of a problem with a conductivity: the whole, and its parts if there are several. */
  std::vector<Part> parts;
  std::vector<Contact> contacts;   ///< of bodies
  std::vector<Integral> integrals; ///< over the groups that the problem asks for
  std::vector<double> mean;        ///< per column: the mean of u, weighted with area or volume
  std::vector<Extreme> minimum;    ///< per column: the smallest value of u
  std::vector<Extreme> maximum;    ///< per column: the largest value of u
  std::vector<double> source;      ///< per column: the total of f, less removed_source
  std::vector<double> screening;   ///< per column: the total of s u
  /** Per column: what flows in through all conditions and sources less what screening takes, over
   * the sum of the magnitudes of all terms, from -1 to 1; of the size of the tolerance. 0 if
   * nothing flows; NaN if a flux is. */
  std::vector<double> balance;
  std::optional<Distance> distance; ///< of a distance; else none
  std::optional<Areas> areas;       ///< of area(); else none
  std::optional<Inverted> inverted; ///< set when a deformed mesh is read: MovedMesh::source()
  /** Of a solve on several processes; else none. Then the other figures are of all processes, the
   * memory is that of the process that took most, and `cycles` counts iterations. */
  std::optional<Distributed> distributed;
  /** Remarks for the user, a sentence each: how free components were treated, why the solve did not
   * converge ... */
  std::vector<std::string> notes;
  /** Those of the notes after which the result may not be what was meant. */
  std::vector<std::string> warnings;

  /** Adds a note that is a warning. */
  void warn(const std::string& sentence)
  {
    this->notes.push_back(sentence);
    this->warnings.push_back(sentence);
  }

  /** The last of the residuals; 0 if no V-cycle was needed. */
  double residual() const { return this->residuals.empty() ? 0.0 : this->residuals.back(); }
  /** For example "relative residual 1.2e-09, to that of the best constant"; without V-cycles that
   * none was needed. */
  std::string residualText() const;

  /**
   * The report as a JSON object with the names above. Numbers that are not finite become null.
   * @param indent spaces by which each level is indented; -1: all on one line
   */
  std::string json(int indent = 2) const;
};

} // namespace smg
