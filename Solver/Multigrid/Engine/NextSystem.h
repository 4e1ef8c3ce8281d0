// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace smg
{

/**
 * A further system of equations on a hierarchy, that is, with the matrix of the system before: it
 * gives b and x of the nodes of the finest level. A pass that finishes the last V-cycle of one
 * system can begin the first one of the next behind it. So these may depend on the final values of
 * a node and its neighbours, and k V-cycles for each of two systems take 2 k + 1 passes.
 *
 * The window of the finest level has the values before as its upward state and takes b and x as its
 * downward state (LevelWindow::renew()); without an upward part both are the same state.
 */
class NextSystem
{
public:
  virtual ~NextSystem() = default;

  /** The number of right-hand sides; LevelWindow::stride() must not change. */
  virtual int columns() const = 0;
  /** About the norm of its first residual; 0: unknown. Single precision is scaled by it. */
  virtual double scale() const = 0;
  virtual void startPass() = 0;
  /** Loads what it needs of the vertices that the window has loaded, between two steps. */
  virtual void load() = 0;
  /** The number of vertices whose final values before it has taken. */
  virtual std::int64_t taken() const = 0;
  /** Fills b and x as far as possible, given that the values before of the vertices below `final`
   * are final. Returns the end of the vertices that are complete, with all their neighbours. */
  virtual std::int64_t fill(std::int64_t final) = 0;
  virtual void endPass() = 0;
};

} // namespace smg
