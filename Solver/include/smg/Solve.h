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

/** The acceleration of V-cycles by the results of previous ones. */
enum class AccelerationKind
{
  /** Conjugate gradients if four or more V-cycles are expected; none for a fixed number of
   * V-cycles. */
  Automatic,
  None,
  /**
   * Chebyshev polynomials for the measured rate of convergence. One vector in memory and on disk.
   */
  Chebyshev,
  /**
   * Conjugate gradients with the V-cycle as preconditioner, in the form that minimises the residual
   * (conjugate residuals), one pass per step. One vector and three more at a sample of the vertices
   * (at all vertices of small meshes or meshes with slivers).
   */
  ConjugateGradients
};

/** Options of solve(). The defaults suit meshes of any size. */
struct SolveOptions
{
  /**
   * The name of the operator set of the library: "extended", or "shi2006": the equations of the
   * paper for comparison, whose result is not the solution and which work in core only. For
   * user-defined sets see SolveWith.h.
   */
  std::string operators = "extended";
  /** Gauss-Seidel sweeps before and after each coarse-grid correction, 1 to 20. */
  int sweeps = 2;
  /** Stop when ||b - A x|| <= tolerance ||b - A x_0||; in (0, 1). */
  double tolerance = 1e-6;
  /** The maximum number of V-cycles, at least 1. */
  int maxCycles = 50;
  AccelerationKind acceleration = AccelerationKind::Automatic;
  /** The limit of the accounted memory in bytes. */
  std::int64_t memoryLimit = std::int64_t(1) << 30;
  /** Compute threads, at least 1; 0: one per core. The result does not depend on it. */
  int threads = 0;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  /** Whether to keep all levels in memory and write no files: the reference. */
  bool inCore = false;
  /** The number of nodes by which a stage advances before the next stage follows. The result does
   * not depend on it. */
  std::int64_t blockNodes = 4096;
  /** Levels with at most this many expected nodes are kept in memory. The result does not depend on
   * it. */
  std::int64_t coreNodes = 50000;
  ProgressFunction progress;
};

/**
 * Solves the problem on the mesh stream, which is read once.
 * @throws Error if an option is out of range, the stream or the problem is invalid, the memory
 * limit is too low (immediately, with the required and the allowed memory), or a scratch file
 * fails; Cancelled by the progress callback. Neither an exception nor ~Solution leaves scratch
 * files behind.
 */
SMG_EXPORT std::unique_ptr<Solution> solve(
  MeshSource& mesh, Problem& problem, const SolveOptions& options = {});

} // namespace smg
