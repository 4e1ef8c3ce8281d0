// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Deform.h"
#include "smg/DescribedHandles.h"
#include "smg/DescribedProblem.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Problem.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/**
 * The part of a mesh that a process has: some of its cells, with all vertices that these use. Every
 * cell is in exactly one part. Every vertex has one owner among the processes that have it, and
 * each process owns consecutive vertices: process 0 the first ones of the mesh, process 1 the next
 * ones, and so on. A part may lack cells, vertices, or both.
 */
struct MeshPart
{
  /** The numbers of vertices and cells of the whole mesh, the kind of cells, and the columns that
   * `block` has. */
  StreamInfo info;
  std::vector<std::int64_t> ids; ///< stream indices of the vertices of `block`, ascending
  std::int64_t firstOwned = 0;   ///< the vertices from this stream index on ...
  std::int64_t endOwned = 0;     ///< ... to this one, which is excluded, are the process's own
  /** The cells with their vertices, which are numbered by their places in `ids`. firstVertex and
   * finalized are 0; firstCell is the stream index of the first cell, for messages. */
  MeshBlock block;
};

/** How to solve with several processes; the same on all of them. */
struct DistributedOptions
{
  /** As SolveOptions::tolerance; it applies to each right-hand side. */
  double tolerance = 1e-8;
  /** Largest number of iterations for each right-hand side, at least 1. */
  int maxIterations = 200;
  /** Limit of the memory of each process, bytes. The assembly of its part is accounted for; the
   * matrix and its hierarchy, which hypre allocates, are estimated before they are built. */
  std::int64_t memoryLimit = INT64_MAX;
  /** Progress callback, called on process 0 alone; empty: none. */
  ProgressFunction progress;
};

/** The solution at the vertices of a part. */
struct DistributedSolution
{
  int columns = 1;            ///< number of columns of the problem
  std::vector<double> values; ///< `columns` numbers for each vertex of MeshPart::block
  Report report;              ///< of all processes, the same on each; seconds: of the slowest
  /** Set by DistributedSolver::evaluate(): 3 numbers per column of each cell of MeshPart::block; 0
   * in cells without area or volume. */
  std::vector<double> gradient, flux;
};

/**
 * Solves problems on a mesh whose parts are on several processes, by conjugate gradients with a
 * V-cycle of hypre's BoomerAMG as preconditioner: for machines whose memory holds the matrix.
 *
 *     DistributedSolver solver(MPI_COMM_WORLD, part);
 *     DescribedProblem problem(description, part.info);
 *     solver.prepare(problem);
 *     const DistributedSolution solution = solver.solve(problem, options);
 *
 * All processes call the constructor, each function and the destructor, in the same order. The
 * problem is then the same as for solve(), and the solution agrees up to the tolerance. An Error on
 * one process is thrown on all of them, with the same text.
 *
 * The mesh may have as many vertices as a HYPRE_BigInt can count: 2^31 - 1, or 2^63 - 1 if hypre
 * was built with 64-bit integers, or with mixed ones. A process may own 33,554,431 of them (2^25 -
 * 1), unless hypre was built with 64-bit integers.
 */
class SMG_EXPORT DistributedSolver
{
public:
  /**
   * Finds out which vertices the parts share.
   * @param communicator the processes; it is duplicated
   * @param part the part of this process; it must outlive the solver
   * @throws Error if the parts are not valid or do not fit together, or a vertex of several parts
   * does not have the same position in each
   */
  DistributedSolver(MPI_Comm communicator, const MeshPart& part);
  ~DistributedSolver();
  DistributedSolver(const DistributedSolver&) = delete;
  DistributedSolver& operator=(const DistributedSolver&) = delete;

  /** Throws Error if several parts have a cell with the same vertices, which would count several
   * times. A mesh that has the same cell twice is refused as well if these are in two parts. */
  void checkCells();

  /**
   * As DescribedProblem::prepare() and DescribedHandles::prepare(), and required wherever these
   * are. If the mesh has no column OriginalId and the description selects vertices by their
   * numbers, the parts must have that column, with stream indices. The memory limit is for each
   * process.
   */
  void prepare(DescribedProblem& problem, const std::filesystem::path& scratch = {},
    std::int64_t memoryLimit = INT64_MAX);
  void prepare(DescribedHandles& handles, const std::filesystem::path& scratch = {},
    std::int64_t memoryLimit = INT64_MAX);

  /**
   * Solves a problem.
   * @param problem the problem. It is queried once, for the part as the only block of its mesh:
   * vertices of several parts must get the same answer on each.
   * @param options how to solve
   * @throws Error as solve(), and if a vertex of several parts gets different answers. Not reaching
   * the tolerance is not an error: see Report::converged.
   * @throws Cancelled if the progress callback returns false
   */
  DistributedSolution solve(Problem& problem, const DistributedOptions& options = {});

  /**
   * Evaluates a solution on all parts: sets conditions, energy, mean, minimum, maximum, source,
   * screening and balance of its report, as SolvedMesh::finish() does on one process, and the
   * requested gradients and fluxes of the cells of the part.
   * @param problem the problem of the solution; it is queried once more
   * @param solution what solve() returned
   * @param options what is requested; the memory limit is for each process
   */
  void evaluate(Problem& problem, DistributedSolution& solution, const ResultOptions& options = {});

  /**
   * Deforms the mesh by handles, as smg::deform() does: two problems with one matrix, for which the
   * preconditioner is set up once. Each of the seven right-hand sides is solved to the tolerance.
   * @param handles the handles. They are queried once, for the part as the only block of its mesh:
   * vertices of several parts must get the same answer on each.
   * @param weights as DeformOptions::weights
   * @param options how to solve
   * @return the positions of the vertices of the part: three columns, x, y, z. Report::steps has
   * both steps.
   * @throws Error as smg::deform(). Not reaching the tolerance is not an error: see
   * Report::converged.
   * @throws Cancelled if the progress callback returns false
   */
  DistributedSolution deform(
    Handles& handles, Weights weights = Weights::Clamped, const DistributedOptions& options = {});
  /** After deform(): the remarks of DescribedHandles::notes() on the whole mesh. */
  std::vector<std::string> notes(const DescribedHandles& handles);

  /**
   * Passes the whole solution to `use` on process 0, as solve() on one process would return it.
   * What process 0 does not own is read from the owners of the vertices; the other processes wait.
   * @param solution the solution of the part
   * @param use called on process 0 alone
   * @throws Error what `use` throws, on all processes
   */
  void gather(const DistributedSolution& solution, const std::function<void(Solution&)>& use);

  /** Replaces the `columns` numbers of each vertex of the part by their sums over all parts that
   * have the vertex. */
  void sum(std::span<double> values, int columns);

  /** Runs `work` on this process, and throws Error on all of them if it throws on one. It must not
   * call the functions of the solver. */
  void together(const std::function<void()>& work);

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
