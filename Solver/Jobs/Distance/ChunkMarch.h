// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Jobs/Distance/MarchWindow.h"

#include <cstdint>
#include <functional>

namespace smg
{

/**
 * Marches the front of a distance through a mesh in chunks, in passes over the stream in
 * alternating directions. At each position of the window a pass settles what it can; what crosses
 * an end of the window is left to a later position. A position without anything to do is not read.
 */
class ChunkMarch
{
public:
  ChunkMarch(ChunkedMesh& mesh, Pool& pool)
    : Window(mesh, pool)
  {
  }
  virtual ~ChunkMarch() = default;

  /** Makes passes until nothing changes, but at most `maxPasses`, and returns their number. Reports
   * progress from `begin` to 1, and calls `passed` after each pass with the number of vertices that
   * are not settled. */
  int run(int maxPasses, Progress& progress, double begin,
    const std::function<void(std::int64_t unsettled)>& passed);

  /** How often the mesh was read: the number of chunks that were read, over the number of chunks.
   */
  double meshReadings() const
  {
    return static_cast<double>(this->Window.chunksRead()) /
           static_cast<double>(this->Window.mesh().count());
  }
  /** The window, after run(). */
  MarchWindow& window() { return this->Window; }
  /** The number of dirty vertices: those that had changes to pass on when the last pass ended. */
  std::int64_t unsettled() const;

protected:
  /** Settles the chunks [first, last], which the window shows. */
  virtual void settle(std::int64_t first, std::int64_t last) = 0;
  /** To be called now and then while settling. Throws Cancelled. */
  void poll() { this->Reported->update(this->Done); }

  MarchWindow Window;

private:
  void countDirty(std::int64_t first, std::int64_t last);
  void pass(bool forwards, Progress& progress, double begin, double end);

  Progress* Reported = nullptr;
  double Done = 0;
};

} // namespace smg
