// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Core/Report.h"
#include "Solver/Problem/Problem.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace smg
{

/** How V-cycles are made to converge faster: each takes what the ones before it have found. */
enum class AccelerationKind
{
  /** Conjugate gradients where four V-cycles or more are to be expected, and not for a fixed number
   * of V-cycles. */
  Automatic,
  None,
  /** Chebyshev polynomials for a rate measured on the way. One vector in memory and on disk. */
  Chebyshev,
  /** Conjugate gradients with the V-cycle as preconditioner, in the form that minimises the
   * residual (conjugate residuals), one pass a step. One vector and, on a sample of the vertices of
   * a large mesh or on all of a small one or of one with slivers, three more. */
  ConjugateGradients
};

/** How to solve. The defaults suit a mesh of any size. */
struct SolveOptions
{
  /**
   * Name of the operator set of the library: "extended" (see Solver/Hierarchy/OperatorSet.h), or
   * "shi2006", the paper's own equations, whose result is no solution (see
   * Solver/Shi2006/Shi2006.h); that one works in core only. A set of your own has no name here: see
   * Solver/SolveWith.h.
   */
  std::string operators = "extended";
  /** Gauss-Seidel sweeps before and after each coarse-level correction, 1 to 20. */
  int sweeps = 2;
  /** Stop when ||b - A x|| <= tolerance ||b - A x_0||; in (0, 1). */
  double tolerance = 1e-6;
  /** Most V-cycles, at least 1. */
  int maxCycles = 50;
  AccelerationKind acceleration = AccelerationKind::Automatic;
  /** Promise on the accounted memory, bytes. */
  std::int64_t memoryLimit = std::int64_t(1) << 30;
  /** Compute threads, at least 1; 0: one a core. The result does not depend on it. */
  int threads = 0;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  /** Keep every level in memory and write no file: the reference. */
  bool inCore = false;
  /** Nodes a stage advances by before the next stage follows. Does not change the result. */
  std::int64_t blockNodes = 4096;
  /** Levels that are expected to have at most this many nodes live in memory. Does not change the
   * result. */
  std::int64_t coreNodes = 50000;
  ProgressFunction progress;
};

/** Throws Error if an option other than the operator set's name is out of range; solve() does so,
 * too. */
void checkOptions(const SolveOptions& options);
/** Throws Error unless the library has an operator set of that name, which goes with the other
 * options; solve() does so, too. */
void checkOperators(const SolveOptions& options);
/** Throws Error if the problem has no column; solve() does so, too. */
void checkProblem(const Problem& problem);

/** The solution of a solve: `columns` values a vertex, in stream order, on disk or in memory. */
class Solution
{
public:
  virtual ~Solution() = default;
  virtual std::int64_t vertices() const = 0;
  virtual int columns() const = 0;
  /**
   * Writes the values of vertices [first, first + count) to `values` (columns * count doubles).
   * Any range in any order; in-order ranges cost the range alone. Not to be called by two threads
   * at once. Throws Error.
   */
  virtual void read(std::int64_t first, std::int64_t count, std::span<double> values) = 0;
  /** What the solve did. */
  virtual const Report& report() const = 0;
};

/**
 * Solves the problem on the mesh stream, which is read once.
 * @throws Error when an option is out of range, the stream or the problem is not valid, the memory
 * limit is below the need (at once, with both figures), or a scratch file fails; Cancelled when the
 * progress callback says so. No scratch file is left behind by a throw or by ~Solution.
 */
std::unique_ptr<Solution> solve(
  MeshSource& mesh, Problem& problem, const SolveOptions& options = {});

} // namespace smg
