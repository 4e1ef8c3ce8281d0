// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/ChunkMarch.h"

#include <algorithm>

namespace smg
{

int ChunkMarch::run(int maxPasses, Progress& progress, double begin,
  const std::function<void(std::int64_t unsettled)>& passed)
{
  int passes = 0;
  for (std::int64_t left = this->unsettled(); passes < maxPasses && left > 0; ++passes)
  {
    // The number of passes to come is not known: each gets half of what is left of the progress.
    const double end = begin + 0.5 * (1 - begin);
    this->pass(passes % 2 == 0, progress, begin, end);
    begin = end;
    left = this->unsettled();
    passed(left);
  }
  this->Window.flush();
  return passes;
}

/** Each chunk counts its dirty vertices, so that this needs no reading. */
std::int64_t ChunkMarch::unsettled() const
{
  std::int64_t dirty = 0;
  for (const ChunkedMesh::Chunk& chunk : this->Window.mesh().chunks)
  {
    dirty += chunk.dirty;
  }
  return dirty;
}

/** Counts anew what is left to pass on: vertices of any shown chunk may have become dirty or clean.
 */
void ChunkMarch::countDirty(std::int64_t first, std::int64_t last)
{
  ChunkedMesh& mesh = this->Window.mesh();
  for (std::int64_t chunk = first; chunk <= last; ++chunk)
  {
    const std::uint8_t* const flags = this->Window.flags() + this->Window.placeOf(chunk);
    const auto dirty = std::count_if(
      flags, flags + mesh.countOf(chunk), [](std::uint8_t bits) { return (bits & Dirty) != 0; });
    mesh.chunks[std::size_t(chunk)].dirty = dirty + std::ssize(this->Window.waiting(chunk));
  }
}

/** Moves the window over the stream, by one chunk at a time, and settles each position that has
 * dirty vertices. A path that leaves the window on the side of the direction is picked up by the
 * next position, one on the other side by the next pass. */
void ChunkMarch::pass(bool forwards, Progress& progress, double begin, double end)
{
  ChunkedMesh& mesh = this->Window.mesh();
  const std::int64_t shown = std::min(ChunkPlan::WindowChunks, mesh.count());
  const std::int64_t positions = mesh.count() - shown + 1;
  this->Reported = &progress;
  for (std::int64_t p = 0; p < positions; ++p)
  {
    const std::int64_t first = forwards ? p : positions - 1 - p;
    const std::int64_t last = first + shown - 1;
    const auto isDirty = [](const ChunkedMesh::Chunk& chunk) { return chunk.dirty > 0; };
    if (std::any_of(mesh.chunks.begin() + first, mesh.chunks.begin() + last + 1, isDirty))
    {
      this->Window.show(first, last);
      this->settle(first, last);
      this->countDirty(first, last);
    }
    this->Done =
      begin + (end - begin) * static_cast<double>(p + 1) / static_cast<double>(positions);
    progress.update(this->Done);
  }
}

} // namespace smg
