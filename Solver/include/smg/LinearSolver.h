// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Problem.h"
#include "smg/ProblemDescription.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace smg
{

/** Some vertices and columns of vectors. */
struct VectorBlock
{
  std::int64_t first;   ///< the first vertex, by its stream index
  std::int64_t count;   ///< the number of vertices
  std::int64_t column;  ///< the first column
  std::int64_t columns; ///< the number of columns
};

/** Sets right-hand sides `b` and initial values `x` of a block, both 0 when it is called: `columns`
 * numbers for each vertex, side by side. Blocks come in ascending order; with several threads the
 * call is made on one of the solver. */
using GivenVectors =
  std::function<void(const VectorBlock& block, std::span<double> b, std::span<double> x)>;
/** Takes the solution of a block, in the same way. */
using TakenVectors = std::function<void(const VectorBlock& block, std::span<const double> x)>;

/**
 * The equations A x = b of a problem with their hierarchy, in memory: built once, solved for one
 * right-hand side after the other. The hierarchy can also precondition an iteration of the caller.
 *
 * A is the matrix of the problem: the weights of its edges, and the screening, Robin coefficients
 * and soft conditions on the diagonal, in the precision in which the engine computes with them. A
 * row is that of the identity at *fixed* vertices, which are those with a Dirichlet condition and
 * those that nothing determines (Report::held). The part of A on the other vertices is symmetric
 * and positive definite, or semidefinite if there are free components; their rows have entries for
 * fixed neighbours, too. So b is the load of each free vertex (as the integral of f times its basis
 * function, plus fluxes and what Robin and soft conditions pull to), and the value of each fixed
 * one. What the problem itself has as sources, fluxes and values has no part in it.
 *
 * Vectors have the vertices in stream order, and any number of columns: those of a vertex lie side
 * by side. As many as the problem has are solved together, then the next ones, the last time with
 * zeros for what is lacking; each time the norms are those of these columns together.
 *
 * One thread may use a solver at a time, of the process that has made it: in a forked child, which
 * would share its memory, all functions that compute throw Error.
 */
class SMG_EXPORT LinearSolver
{
public:
  /**
   * Builds matrix and hierarchy.
   * @param mesh the stream, read once
   * @param problem the problem, asked once for each block
   * @param options how to solve: SolveOptions::inCore is implied; tolerance, maxCycles and
   * acceleration are those of solve(); the progress is that of building
   * @throws Error, Cancelled as smg::solve() in core; Error if the problem ties vertices to others
   */
  LinearSolver(MeshSource& mesh, Problem& problem, const SolveOptions& options = {});
  /** The same for the problem of a description, which need not say anything. `name` is what errors
   * call it. */
  LinearSolver(const StoredMesh& mesh, const ProblemDescription& problem,
    const SolveOptions& options = {}, const std::string& name = "problem");
  ~LinearSolver();
  /** Takes the equations of the other, which is not to be used after. */
  LinearSolver(LinearSolver&& other) noexcept;
  /** The same in place of those that it has. */
  LinearSolver& operator=(LinearSolver&& other) noexcept;

  /** Number of vertices of the mesh, the rows of A. */
  std::int64_t vertices() const;
  /** Number of columns that are solved together: those of the problem. */
  int columns() const;

  /**
   * Solves A x = b. The result does not depend on earlier calls, and has the bits of smg::solve()
   * in core for the same b and initial values. On a free component A is singular: the mean is taken
   * from the sources, so that b sums to 0, and x keeps the mean of the initial guess, both weighted
   * with the area or volume at the vertices.
   * @param b the right-hand side: `columns` numbers for each vertex
   * @param x the initial guess, and the solution: as many numbers; must not overlap b. At fixed
   * vertices b is taken. After an exception, columns that were complete have their solution, others
   * are unchanged.
   * @param tolerance as SolveOptions::tolerance, of each group of columns that are solved together;
   * between 0 and 1, both excluded
   * @param maxCycles largest number of V-cycles of each group, at least 1
   * @param progress progress callback; empty: none
   * @return the report, valid until the next call; of several groups, `steps` has them one after
   * the other. It is no error if the tolerance is not reached: see Report::converged.
   * @throws Error if an argument is not valid or a number not finite, numbers overflow, or the
   * residual grows beyond recovery
   * @throws Cancelled if the progress callback returns false. The solver remains usable.
   */
  const Report& solve(std::span<const double> b, std::span<double> x, double tolerance = 1e-8,
    int maxCycles = 50, const ProgressFunction& progress = {});

  /**
   * z = M r: one V-cycle from 0, that is linear and symmetric, unlike those of solve(): for
   * conjugate gradients and others. M is positive definite; on fixed vertices it is the identity,
   * without effect on others. Symmetric up to the rounding of single precision, in which coarse
   * levels compute. On one thread.
   * @param r `columns` numbers for each vertex
   * @param z set to M r: as many numbers; may be r
   * @throws Error as solve()
   */
  void precondition(std::span<const double> r, std::span<double> z);

  /**
   * y = A x. For conjugate gradients begin with x = b at fixed vertices: what they multiply is then
   * symmetric. On one thread.
   * @param x `columns` numbers for each vertex
   * @param y set to A x: as many numbers; may be x
   * @throws Error as solve()
   */
  void multiply(std::span<const double> x, std::span<double> y);

  /** The report of the last solve; before the first one that of building. */
  const Report& report() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

/**
 * The equations A x = b of a LinearSolver with their hierarchy on scratch files, within a memory
 * limit, for meshes that are too large for memory: built once, solved for one right-hand side after
 * the other. A solve with k V-cycles takes k + 1 passes over the scratch files, which stay as long
 * as the object; the mesh is not read again.
 *
 * One thread may use it at a time, of the process that has made it.
 */
class SMG_EXPORT SystemOnDisk
{
public:
  /**
   * Builds matrix and hierarchy.
   * @param mesh the stream, read once
   * @param problem the problem, asked once for each block
   * @param options how to solve, as for smg::solve() out of core: threads, memoryLimit, scratch and
   * scratchLimit are those of later solves, too; there are no checkpoints
   * @throws Error, Cancelled as smg::solve(); Error if the problem ties vertices to others
   */
  SystemOnDisk(MeshSource& mesh, Problem& problem, const SolveOptions& options = {});
  /** The same for the problem of a description, which need not say anything. `name` is what errors
   * call it. */
  SystemOnDisk(const StoredMesh& mesh, const ProblemDescription& problem,
    const SolveOptions& options = {}, const std::string& name = "problem");
  ~SystemOnDisk();
  /** Takes the equations of the other, which is not to be used after. */
  SystemOnDisk(SystemOnDisk&& other) noexcept;
  /** The same in place of those that it has. */
  SystemOnDisk& operator=(SystemOnDisk&& other) noexcept;

  /** Number of vertices of the mesh, the rows of A. */
  std::int64_t vertices() const;
  /** Number of columns that are solved together: those of the problem. */
  int columns() const;

  /**
   * Solves A x = b, with the vectors a block at a time, so that they need not be in memory. The
   * solution has the bits of smg::solve() for the same b and initial values; where the memory limit
   * is near what acceleration needs, later solves may be accelerated otherwise, within the
   * tolerance.
   * @param columns the number of right-hand sides, at least 1; as many as the problem has are
   * solved together
   * @param give called once for each vertex and group of columns; its exceptions end the solve
   * @param take called after each group, for all vertices in ascending order
   * @param tolerance, maxCycles, progress as for LinearSolver::solve()
   * @return the report, valid until the next call
   * @throws Error, Cancelled as LinearSolver::solve(); the object remains usable
   */
  const Report& solve(std::int64_t columns, const GivenVectors& give, const TakenVectors& take,
    double tolerance = 1e-8, int maxCycles = 50, const ProgressFunction& progress = {});
  /** The same for vectors in memory: see LinearSolver::solve(). */
  const Report& solve(std::span<const double> b, std::span<double> x, double tolerance = 1e-8,
    int maxCycles = 50, const ProgressFunction& progress = {});

  /** The report of the last solve; before the first one that of building. */
  const Report& report() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
