// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"

#include <cstdint>
#include <filesystem>
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
   * Name of the operator set of the library: "extended" (see Solver/Operators/OperatorSet.h), or
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

} // namespace smg
