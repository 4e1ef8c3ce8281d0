// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Problem.h"
#include "smg/ProblemDescription.h"
#include "smg/Report.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace smg
{

class Orientation; // private: Solver/Jobs/Fairing/Orientation.h

/** Bytes of a mebibyte, for limits: 256 * MiB. */
inline constexpr std::int64_t MiB = std::int64_t(1) << 20;

/** How V-cycles are accelerated, from what the V-cycles before have found. */
enum class AccelerationKind
{
  /** Conjugate gradients if four or more V-cycles are to be expected and their number is not fixed;
   * else none. */
  Automatic,
  None, ///< V-cycles alone
  /** Chebyshev polynomials (Golub and Varga 1961) for the measured rate of convergence. One vector
   * in memory and on disk. */
  Chebyshev,
  /** Conjugate gradients preconditioned by the V-cycle, in the form that minimises the residual
   * (conjugate residuals), with one pass a step. One vector, and three more on a sample of the
   * vertices of a large mesh, or on all vertices of a small mesh or of one with slivers. */
  ConjugateGradients
};

/**
 * How a solve can continue where it was killed. It keeps its scratch files in a folder, and after
 * each pass its state, when the disk has both. The same solve, called again, continues after the
 * last complete pass and has the same result, bit for bit. Only scratch, threads, blockNodes and
 * progress may differ then.
 */
struct CheckpointOptions
{
  /**
   * The folder, for this checkpoint alone: it is made if it does not exist; else it must be empty
   * or have the checkpoint. It stays until Solution::removeCheckpoint(). Empty: no checkpoint. It
   * takes the place of SolveOptions::scratch, and has about the same size.
   */
  std::filesystem::path folder;
  /** A text that is another one if the mesh is, for example VsmReader::fingerprint(). Not empty
   * with a folder. */
  std::string mesh;
  /** A text that is another one if the problem is, for example the problem file. Not empty with a
   * folder. */
  std::string problem;
};

/** What a stage of a pass did in a step, or what a level has in memory after it. */
struct TraceEntry
{
  int pass;          ///< of the solve, from 1 on
  std::int64_t step; ///< of the pass, from 1 on
  int level;         ///< of the stage; 0: the finest
  /** The stage, with the number of the sweep if it is one; of a level, "in memory". Valid during
   * the call. docs/architecture.md lists them. */
  std::string_view stage;
  std::int64_t first; ///< the first node that the stage has passed in this step, or in memory
  /** Behind the last one. In the first pass vertices that wait for their cells are in memory, too.
   * "P^T A P" and "sparsify, finish rows" count nodes of the next coarser level. */
  std::int64_t end;
};
/** Called between two steps, by the thread of solve(), for each stage that has advanced and each
 * level whose window has moved. What it throws ends the solve. */
using TraceFunction = std::function<void(const TraceEntry& entry)>;

/** How to solve. The defaults suit a mesh of any size. */
struct SolveOptions
{
  /**
   * Name of an operator set of the library: "extended" is the only one. The equations of the
   * paper, for comparison, have a program of their own: solve_shi2006. For operators of a program's
   * own see SolveWith.h.
   */
  std::string operators = "extended";
  /** Gauss-Seidel sweeps before and after each coarse-level correction, 1 to 20. */
  int sweeps = 2;
  /** The solve stops when ||b - A x|| <= tolerance * min over the constants c of ||b - A c||: it is
   * as exact from any initial values, and with any constant added to all values. Where the initial
   * values are a mesh at rest, as in deform() and smooth(), ||b - A x_0|| takes its place. Between
   * 0 and 1, both excluded, or AutomaticTolerance. At 1e-8 a solution agrees with that of a direct
   * solver to the digits of a float. */
  double tolerance = 1e-8;
  /**
   * Of solve() alone: it stops when the algebraic error is below a tenth of the discretisation
   * error of linear finite elements on the mesh, both estimated in the energy norm (see
   * Report::errors), or at a residual of 1e-13. More V-cycles would not bring the result nearer to
   * the solution of the continuous problem. Needs `again`; not for Weights::Uniform.
   */
  static constexpr double AutomaticTolerance = 0.0;
  /** Opens the mesh that is solved on once more, from its first block. With AutomaticTolerance it
   * is read, and the problem is asked, once to six times after some V-cycles. With another one it
   * is up to four times if conductivities differ by more than 100 and fluxes need more digits than
   * a double: without `again` those that are lost are NaN. */
  std::function<std::unique_ptr<MeshSource>()> again{};
  /** Largest number of V-cycles, at least 1; with those of corrections (Solution::hasRest()). */
  int maxCycles = 50;
  /** How V-cycles are accelerated. */
  AccelerationKind acceleration = AccelerationKind::Automatic;
  /** Limit of the accounted memory, bytes; more than 0. */
  std::int64_t memoryLimit = std::int64_t(1) << 30;
  /** Compute threads, at least 1, of which at most 16 are used; 0: one a core. The result does not
   * depend on it; each takes some memory, as far as the limit allows. */
  int threads = 0;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch{};
  /** Whether and where to keep what a killed solve needs to continue; not with `inCore`. */
  CheckpointOptions checkpoint{};
  /** Limit of the bytes of scratch files that exist at once; 0: none. */
  std::int64_t scratchLimit = 0;
  /** Keep all levels in memory and write no file. The result is the same, bit for bit. */
  bool inCore = false;
  /** Nodes by which a stage advances at a time, at least 1. The result does not depend on it. */
  std::int64_t blockNodes = 4096;
  /** Levels that are expected to have at most so many nodes are kept in memory; at least 0. The
   * first of them that is much smaller than the finest level is solved more accurately than one
   * V-cycle does: so the iterates depend on it, except on small meshes. */
  std::int64_t coreNodes = 50000;
  /** Progress callback; empty: none. */
  ProgressFunction progress{};
  /** Called with how the passes move over the levels, step by step; empty: none. */
  TraceFunction trace{};
};

/** What to compute from a solution. */
struct ResultOptions
{
  bool gradient = false; ///< grad u of each cell
  bool flux = false;     ///< -K grad u of each cell
  /** grad u at each vertex: the mean of its cells, weighted by area or volume. It takes a reading
   * of the mesh before, and a scratch file. Not with several processes. */
  bool gradientAtVertices = false;
  /** Groups of cells for Report::integrals: see ProblemDescription::integrals. */
  std::vector<std::string> integrals = {};
  /** Limit of the accounted memory, bytes; 1 GiB by default. */
  std::int64_t memoryLimit = std::int64_t(1) << 30;
  /** With 1 thread the mesh is not read ahead; otherwise a further thread does so. 0 by default. */
  int threads = 0;
  /** Folder of the scratch file; empty: the system's temporary folder. */
  std::filesystem::path scratch = {};
};

/** The solution of a problem: columns() values a vertex, in stream order, on disk or in memory. */
class SMG_EXPORT Solution
{
public:
  virtual ~Solution() = default;
  /** Number of vertices of the mesh. */
  virtual std::int64_t vertices() const = 0;
  /** Number of values of a vertex: the columns of the problem, or 3 of a deformation. */
  virtual int columns() const = 0;
  /**
   * Reads the values of the vertices [first, first + count). Any range may be read in any order;
   * consecutive ranges cost no more than their own values. Not for two threads at once.
   * @param first stream index of the first vertex
   * @param count number of vertices
   * @param values set to the values, vertex by vertex: room for columns() * count numbers
   * @throws Error if the range or the room is not valid, or a scratch file cannot be read
   */
  virtual void read(std::int64_t first, std::int64_t count, std::span<double> values) = 0;
  /** Whether the values have more digits than a double: see readRest(). False by default. */
  virtual bool hasRest() const { return false; }
  /**
   * Reads what rounding to double has taken from the values, as read() does: their sum is the
   * solution. Where conductivities differ by 1e8 and more, what flows in the good conductors is in
   * these digits. Only to be called if hasRest().
   */
  virtual void readRest(std::int64_t /*first*/, std::int64_t /*count*/, std::span<double> values)
  {
    std::ranges::fill(values, 0.0);
  }
  /** How the mesh with the result is wound, if not as the mesh: for MovedMesh. Null by default. */
  virtual Orientation* winding() { return nullptr; }
  /** Removes the checkpoint, if there is one, when the solution is destroyed: to be called when the
   * result is complete on disk. */
  virtual void removeCheckpoint() {}
  /** What the solve did; SolvedMesh::finish() completes a copy of it. */
  virtual const Report& report() const = 0;
};

/**
 * Solves a problem on a mesh stream by multigrid, out of core: after Shi, Bao and Zhou 2009, with
 * other coarse equations, which converge to the solution.
 * @param mesh the stream, read once
 * @param problem the problem, asked once for each block
 * @param options how to solve
 * @return the solution, problem.columns() values a vertex, and the report. It keeps its scratch
 * files until it is destroyed.
 * @throws Error if an option is out of range, the stream or the problem is not valid, the memory
 * limit is below the need (with both figures, and before the mesh is read if its span is known),
 * numbers overflow, the residual grows beyond recovery, scratch files would exceed their limit or
 * cannot be written or read, or a checkpoint is damaged, in use, or of another mesh, problem or
 * option; no scratch file remains except those of a checkpoint. It is no error if the tolerance is
 * not reached: see Report::converged.
 * @throws Cancelled if the progress callback returns false
 */
SMG_EXPORT std::unique_ptr<Solution> solve(
  MeshSource& mesh, Problem& problem, const SolveOptions& options = {});

/**
 * Solves the problem of a description on a stored mesh, as DescribedProblem and the other solve()
 * do.
 * @param mesh the mesh, read once, and once more if the description selects parts of it
 * @param problem the problem
 * @param options how to solve; `again`, and the texts of a checkpoint that are empty, are set
 * @param name what error messages call the description, for instance its file
 * @return as the other solve()
 * @throws Error as the other solve(), and if the description gives nothing to solve for or does not
 * fit the mesh
 */
SMG_EXPORT std::unique_ptr<Solution> solve(const StoredMesh& mesh,
  const ProblemDescription& problem, const SolveOptions& options = {},
  const std::string& name = "problem");

} // namespace smg
