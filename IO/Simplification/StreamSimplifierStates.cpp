// SPDX-License-Identifier: BSD-3-Clause
// The checkpoint of a StreamSimplifier: its state whenever the window was simplified, and each part
// of the result.
#include "IO/Simplification/StreamSimplifier.h"

#include "smg/Error.h"

#include <algorithm>
#include <utility>

namespace smg
{

/** What is saved when the window was full; the rest follows from the stream. */
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

/** The checkpoint of a part of the result. */
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
  const std::size_t least = this->Capacity;
  this->exchange(*state);
  state->finish();
  const SurfacePart& window = this->Window;
  state->require(window.points.size() == 3 * window.vertices() &&
                 window.quadrics.size() == window.vertices() &&
                 window.lacksBoundary.size() == window.vertices() &&
                 window.corners.size() % 3 == 0 && this->Capacity >= least &&
                 std::ranges::all_of(window.corners,
                   [&window](std::uint32_t corner) { return corner < window.vertices(); }));
  this->enlarge(std::exchange(this->Capacity, least));
  this->renumber();
  this->Counts.resumedAt = this->TakenVertices;
  this->ResumedResults = this->KeptResults;
  StreamPart taken;
  for (std::int64_t k = 0; k < this->TakenParts; ++k)
  {
    this->Parts.next(taken);
  }
}

/** Finds the vertices of later parts in the window again. */
void StreamSimplifier::renumber()
{
  this->Open.clear();
  for (std::size_t v = 0; v < this->Window.vertices(); ++v)
  {
    if (this->Window.ids[v] >= this->End)
    {
      this->Open.emplace(this->Window.ids[v], static_cast<std::uint32_t>(v));
    }
  }
}

} // namespace smg
