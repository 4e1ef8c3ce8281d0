// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Problem.h"
#include "smg/Solution.h"

#include <cstdint>
#include <filesystem>
#include <memory>
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
   * Name of the operator set of the library: "extended", or
   * "shi2006", the paper's own equations, whose result is no solution and which works in core only,
   * for comparison. A program's own set has no name here: see SolveWith.h.
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

/**
 * Solves the problem on the mesh stream, which is read once.
 * @throws Error when an option is out of range, the stream or the problem is not valid, the memory
 * limit is below the need (at once, with both figures), or a scratch file fails; Cancelled when the
 * progress callback says so. No scratch file is left behind by a throw or by ~Solution.
 */
SMG_EXPORT std::unique_ptr<Solution> solve(
  MeshSource& mesh, Problem& problem, const SolveOptions& options = {});

} // namespace smg
