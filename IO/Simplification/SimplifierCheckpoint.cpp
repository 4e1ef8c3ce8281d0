// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Mesh/Columns.h"
#include "IO/Simplification/StreamSimplifier.h"
#include "smg/Error.h"

#include <algorithm>
#include <utility>

// The checkpoint of a StreamSimplifier: its state whenever the window was simplified, and each part
// of the result.

namespace smg
{

namespace
{

/** Whether the lists of a surface from a file have the lengths that they say, with rows of so many
 * bytes, and the corners are vertices. */
bool isConsistent(const SurfacePart& surface, const StreamInfo& info)
{
  const auto row = static_cast<std::size_t>(rowBytes(info.vertexColumns));
  const auto cellRow = static_cast<std::size_t>(rowBytes(carriedColumns(info)));
  return surface.points.size() == 3 * surface.vertices() &&
         surface.rows.size() == row * surface.vertices() &&
         surface.cellRows.size() == cellRow * surface.triangles() &&
         surface.corners.size() % 3 == 0 &&
         std::ranges::all_of(surface.corners,
           [&surface](std::uint32_t corner) { return corner < surface.vertices(); });
}

} // namespace

/** What is saved when the window has been simplified. Everything else follows from reading the
 * stream to the same place. */
template <class State>
void StreamSimplifier::exchange(State& state)
{
  std::vector<std::int64_t> delivered(this->Delivered.begin(), this->Delivered.end());
  auto capacity = static_cast<std::uint64_t>(this->Capacity);
  state(this->Window, delivered, capacity, this->End, this->DeliveredVertices, this->TakenVertices,
    this->TakenParts, this->FullWindows, this->Counts, this->KeptResults);
  this->Delivered = { delivered.begin(), delivered.end() };
  this->Capacity = static_cast<std::size_t>(capacity);
}

/** A part of the result is a state of its own, with a name of its own. */
Checkpoint StreamSimplifier::keptResult(std::int64_t number) const
{
  return { *this->Folder, this->Subject,
    std::string(Checkpoint::StateName) + "-result-" + std::to_string(number) };
}

void StreamSimplifier::loadResult(std::int64_t number, Result& result)
{
  std::optional<StateReader> state = this->keptResult(number).open(this->Memory);
  if (!state)
  {
    throw Error(this->Folder->path().string() +
                ": the checkpoint is damaged: a part of the result is missing. Remove its folder "
                "to begin anew.");
  }
  (*state)(result);
  state->require(isConsistent(result.surface, this->Info) &&
                 result.isShared.size() == result.surface.vertices());
  state->finish();
}

void StreamSimplifier::save()
{
  if (this->Kept)
  {
    this->Kept->save(this->FullWindows, [this](StateWriter& state) { this->exchange(state); });
  }
}

void StreamSimplifier::keepIn(ScratchFolder& folder, std::vector<Checkpoint::Item> subject)
{
  this->Folder = &folder;
  this->Subject = std::move(subject);
  this->Kept.emplace(folder, this->Subject);
  std::optional<StateReader> state = this->Kept->open(this->Memory);
  if (!state)
  {
    return;
  }
  // The constructor has acquired the memory for its own capacity: only what the window has grown by
  // is added.
  const std::size_t least = this->Capacity;
  this->exchange(*state);
  state->finish();
  state->require(isConsistent(this->Window, this->Info) &&
                 this->Window.quadrics.size() == this->Window.vertices() &&
                 this->Window.lacksBoundary.size() == this->Window.vertices() &&
                 this->Capacity >= least && this->TakenParts >= 0 && this->KeptResults >= 0);
  this->enlarge(std::exchange(this->Capacity, least));
  this->renumber();
  this->Counts.resumedAt = this->TakenVertices;
  this->ResumedResults = this->KeptResults;
  // The same parts are read again, but not simplified.
  StreamPart taken;
  for (std::int64_t k = 0; k < this->TakenParts; ++k)
  {
    this->Parts.next(taken);
  }
  this->Window.labels = taken.surface.labels;
  this->Window.edgeGroups = taken.surface.edgeGroups;
  this->Window.marksHeld = taken.surface.marksHeld;
}

} // namespace smg
