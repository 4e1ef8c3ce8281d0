// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/StreamSimplifier.h"

#include "IO/Simplification/Bodies.h"
#include "IO/Simplification/SeamVertices.h"
#include "IO/Simplification/VertexClusters.h"
#include "IO/Simplification/WindowSize.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

// Simplification of a stream in bounded memory: parts on all threads, appended to a window, which
// is simplified as a whole when it is full. Vertices that others still need are locked at each of
// these steps, so surfaces fit together, and in the window all edges between parts have their turn.
// Parts are taken in the order of the stream (OrderedJobs), so the result does not depend on
// threads.
//
// Memory: 45 % for the window, the same for the parts in work, the rest for open vertices of the
// stream. Time: each triangle is in one part and about twice in a full window. docs/simplify.md has
// measurements.

namespace smg
{
namespace
{

constexpr PoolUse SimplificationMemory{ "the simplification",
  "raise the memory limit, or convert the mesh with the order bfs if it has another" };

constexpr PoolUse ColumnMemory{ "a simplification with so many columns",
  "raise the memory limit, or simplify a mesh with fewer columns" };
constexpr PoolUse HeldMemory{ "the simplification, in which so many vertices stay,",
  "raise the memory limit, or hold fewer vertices" };

/** The least share of its vertices that a part keeps: PartShare, but more, up to UsualShare, where
 * that is not SmallGoal times what will be left of the mesh, so that the window has something to
 * choose from. */
constexpr double PartShare = 1.0 / 16.0, SmallGoal = 16.0, UsualShare = 1.0 / 8.0;

} // namespace

StreamSimplifier::StreamSimplifier(MeshSource& triangles, bool marksHeld,
  const SimplifyTarget& target, std::int64_t memory, Workers& workers,
  std::function<void(double)> progress)
  : Memory(memory, SimplificationMemory)
  , Told(progress)
  , Polled([this] { this->poll(); })
  , Parts(triangles, marksHeld, this->Memory, trianglesOfPart(memory, triangles.info()),
      std::move(progress), this->Polled)
  , Info(triangles.info())
  , Goal{ target.vertices,
    target.error > 0.0 ? target.error : std::numeric_limits<double>::infinity() }
  , Capacity(PartsOfWindow * trianglesOfPart(memory, triangles.info()))
  , Triangles(2 * target.vertices)
  , Jobs(
      workers, PartsOfWindow, // parts in use at once
      [this](Item& item)
      {
        std::vector<std::uint8_t> locked(item.part.surface.vertices());
        std::size_t inside = 0;
        for (std::size_t v = 0; v < locked.size(); ++v)
        {
          locked[v] = item.part.isInside(v) ? 0 : 1;
          const bool isFree = !item.part.surface.isHeld(v) && item.part.surface.seamOf(v) == 0;
          inside += locked[v] == 0 && isFree ? 1 : 0;
        }
        // Vertices that other parts have, that are held or on seams, are all left; the share is of
        // the others.
        CollapseGoal goal{ locked.size() - inside, this->Goal.error, !this->limitsError(),
          !this->limitsError() };
        goal.vertices += static_cast<std::size_t>(item.share * static_cast<double>(inside));
        item.done = collapseEdges(item.part.surface, locked, goal, this->Polled);
      },
      [this](Item& item)
      {
        this->count(item.done);
        this->append(item.part);
      })
{
  workers.whileSleeping([this] { this->ask(); });
  // Twice as many triangles as vertices, unless the mesh says its counts: then in its proportion.
  const auto window = static_cast<std::int64_t>(this->Capacity);
  if (this->Info.cells > 0 && this->Info.vertices > 0)
  {
    const double share =
      static_cast<double>(this->Info.cells) / static_cast<double>(this->Info.vertices);
    this->Triangles = static_cast<std::int64_t>(share * static_cast<double>(target.vertices));
  }
  // The number of cells of the boundary of a solid is not known.
  const bool mayBeLarge = this->Info.cells <= 0 || this->Info.cells > window;
  this->Streams = mayBeLarge && (this->limitsError() || this->Triangles > window / 3);
  if (const std::int64_t bytes = windowBytes(memory, this->Info); bytes > memory)
  {
    throw MemoryLimitError(bytes, memory, ColumnMemory);
  }
  this->Memory.acquire(windowBytes(memory, this->Info));
}

StreamSimplifier::~StreamSimplifier()
{
  // Parts that are in work are not waited for to their end.
  this->IsCancelled = true;
  this->Jobs.workers().whileSleeping({});
}

/** Asks, on the thread of the owner, whether to go on. */
void StreamSimplifier::ask() noexcept
{
  try
  {
    if (this->Told && !this->IsCancelled)
    {
      this->Told(0.0); // shares only grow
    }
  }
  catch (...)
  {
    this->IsCancelled = true;
  }
}

/** Throws Cancelled if the work is not to go on: on any thread, of which the owner asks. */
void StreamSimplifier::poll()
{
  if (!Workers::isCaller())
  {
    this->ask();
  }
  if (this->IsCancelled)
  {
    throw Cancelled();
  }
}

double StreamSimplifier::done() const
{
  const double vertices = static_cast<double>(std::max<std::int64_t>(1, this->Info.vertices));
  return this->Info.vertices > 0 ? static_cast<double>(this->TakenVertices) / vertices : 0.0;
}

bool StreamSimplifier::next(Result& result)
{
  // What a killed program has delivered comes first, from the checkpoint.
  if (this->Replayed < this->ResumedResults)
  {
    this->loadResult(this->Replayed++, result);
    this->Parts.addResult(result.surface);
    return true;
  }
  while (this->Ready.empty() && !this->IsFinished)
  {
    this->step();
  }
  if (this->Ready.empty())
  {
    return false;
  }
  result = std::move(this->Ready.front());
  this->Ready.pop_front();
  this->Parts.addResult(result.surface);
  return true;
}

/** Submits the next part, which appends the oldest one if as many are in work as may be; at the end
 * of the stream appends the rest. */
void StreamSimplifier::step()
{
  Item& item = this->Jobs.next();
  if (this->Parts.next(item.part))
  {
    item.share = this->shareOfPart();
    this->Jobs.submit();
    return;
  }
  while (this->Jobs.size() > 0)
  {
    this->Jobs.takeOldest();
  }
  this->finish();
}

/** The share of its vertices that a part keeps: all, if the stream fits into the window or may do
 * so. */
double StreamSimplifier::shareOfPart() const
{
  const std::int64_t cells = std::max(this->Info.cells, this->Parts.cells());
  if (cells <= static_cast<std::int64_t>(this->Capacity))
  {
    return 1.0;
  }
  const double share = this->Goal.vertices == 0
                         ? 0.0
                         : 2.0 * static_cast<double>(this->Triangles) / static_cast<double>(cells);
  const double least = std::clamp(0.5 * SmallGoal * share, PartShare, UsualShare);
  return share > 0.5 ? 1.0 : std::max(share, this->Goal.vertices == 0 ? UsualShare : least);
}

/** Appends a part to the window. Vertices that it shares with earlier parts are in the window
 * already (Open); their quadrics are added. */
void StreamSimplifier::append(const StreamPart& part)
{
  const SurfacePart& from = part.surface;
  SurfacePart& to = this->Window;
  std::vector<std::uint32_t> places(from.vertices());
  to.origin = from.origin;
  to.labels = from.labels;
  to.edgeGroups = from.edgeGroups;
  to.marksHeld = from.marksHeld;
  if (to.triangles() == 0)
  {
    // At once: moving a full window to a larger place takes long.
    const auto expected = static_cast<std::size_t>(std::max<std::int64_t>(0, this->Info.cells));
    to.reserve(std::min(this->Capacity, std::max(expected, from.triangles())), from);
  }
  for (std::size_t v = 0; v < from.vertices(); ++v)
  {
    this->Polled.at(v);
    const auto place = static_cast<std::uint32_t>(to.vertices());
    if (!part.isInside(v))
    {
      // Only vertices that other parts may have are looked up; those inside cannot be known.
      const auto [known, isNew] = this->Open.try_emplace(from.ids[v], place);
      if (!isNew)
      {
        places[v] = known->second;
        to.quadrics[known->second].add(from.quadrics[v]);
        to.lacksBoundary[known->second] |= from.lacksBoundary[v];
        continue;
      }
    }
    places[v] = place;
    to.addVertex(from, v);
    to.quadrics.push_back(from.quadrics[v]);
    to.lacksBoundary.push_back(from.lacksBoundary[v]);
  }
  for (std::size_t i = 0; i < from.corners.size(); ++i)
  {
    this->Polled.at(i);
    to.corners.push_back(places[from.corners[i]]);
  }
  to.cellRows.insert(to.cellRows.end(), from.cellRows.begin(), from.cellRows.end());
  if (this->Counts.splitsSeams)
  {
    forgetSeams(to, this->Polled);
  }
  this->End = part.end;
  this->TakenVertices = part.endVertex;
  ++this->TakenParts;
  if (to.triangles() > this->Capacity)
  {
    this->makeRoom();
  }
}

StreamSimplifier::Staying StreamSimplifier::staying() const
{
  Staying staying;
  staying.locked.resize(this->Window.vertices());
  for (std::size_t v = 0; v < staying.locked.size(); ++v)
  {
    this->Polled.at(v);
    const std::int64_t id = this->Window.ids[v];
    staying.locked[v] = id >= this->End || this->Delivered.contains(id) ? 1 : 0;
  }
  staying.held = heldVertices(this->Window, staying.locked, this->Polled);
  for (std::size_t v = 0; v < staying.locked.size(); ++v)
  {
    this->Polled.at(v);
    staying.lockedVertices += staying.locked[v];
    staying.heldVertices += staying.locked[v] == 0 ? staying.held[v] : 0;
  }
  return staying;
}

std::vector<std::uint8_t> StreamSimplifier::Staying::all() const
{
  std::vector<std::uint8_t> all = this->locked;
  std::ranges::transform(all, this->held, all.begin(), std::bit_or<>());
  return all;
}

/** For the window alone; the parts keep their size. */
void StreamSimplifier::enlarge(std::size_t capacity)
{
  const auto more = static_cast<std::int64_t>(capacity - this->Capacity);
  this->Memory.acquire(more * bytesOfTriangle(this->Info));
  this->Capacity = capacity;
}

/** Makes the window larger if too many of its vertices are locked, as in a stream with a very large
 * span, or held. Throws Error if the memory does not suffice. */
bool StreamSimplifier::grow()
{
  const Staying staying = this->staying();
  const std::size_t wanted =
    windowOf(this->Capacity, staying.lockedVertices + staying.heldVertices, this->Info);
  if (wanted == this->Capacity)
  {
    return false;
  }
  try
  {
    this->enlarge(wanted);
  }
  catch (const MemoryLimitError& error)
  {
    if (staying.heldVertices > staying.lockedVertices && !this->hasSeams())
    {
      throw error.of(HeldMemory);
    }
    if (this->Counts.splitsSeams || !this->hasSeams())
    {
      throw;
    }
    this->Counts.splitsSeams = true;
    forgetSeams(this->Window, this->Polled);
    return this->grow();
  }
  return true;
}

bool StreamSimplifier::hasSeams() const
{
  for (std::size_t v = 0; v < this->Window.vertices(); ++v)
  {
    this->Polled.at(v);
    if (this->Window.seamOf(v) > 0)
    {
      return true;
    }
  }
  return false;
}

/** Simplifies the full window. Of a result that does not fit into it, a part then leaves it. */
void StreamSimplifier::makeRoom()
{
  if (this->grow())
  {
    return;
  }
  if (!this->Streams)
  {
    // About twice the vertices of the result, within bounds, so that the last simplification can
    // still choose.
    const auto wanted = static_cast<std::size_t>(this->Triangles);
    this->shrink(std::clamp(wanted, this->Capacity / 8, this->Capacity / 4));
  }
  else
  {
    // Each part of the stream gets its share of the vertices of the result.
    const double share = std::ceil(this->done() * this->aim());
    this->fit(static_cast<std::int64_t>(share) - this->DeliveredVertices);
    if (this->Goal.vertices == 0 || this->Window.triangles() > this->Capacity / 2)
    {
      this->deliverOlderHalf();
    }
  }
  // Collapses have moved vertices to other places.
  this->renumber();
  ++this->FullWindows;
  this->save();
}

/** Collapses edges of the window until it has `vertices` vertices that are not locked. The topology
 * is not given up for a number below that of the held ones. */
void StreamSimplifier::collapse(std::int64_t vertices)
{
  const Staying staying = this->staying();
  CollapseGoal goal{ static_cast<std::size_t>(std::max<std::int64_t>(0, vertices)),
    this->Goal.error, !this->limitsError() && staying.heldVertices <= vertices,
    !this->IsFinished && !this->Streams && !this->limitsError() };
  goal.vertices += static_cast<std::size_t>(staying.lockedVertices);
  this->count(collapseEdges(this->Window, staying.locked, goal, this->Polled));
}

void StreamSimplifier::count(const Collapsed& done)
{
  this->Counts.error = std::max(this->Counts.error, done.error);
  this->Counts.dropped += static_cast<std::int64_t>(done.bodies);
  this->Counts.crossesBorders = this->Counts.crossesBorders || done.crossesBorders;
  this->Counts.welded += static_cast<std::int64_t>(done.welded);
  this->Counts.turns = this->Counts.turns || done.turns;
}

/** Removes the smallest bodies of the window, so that so many vertices are enough for the others:
 * no collapse removes a body. Returns whether they are fragments, which stay. */
bool StreamSimplifier::dropBodies(std::int64_t vertices)
{
  SmallBodies bodies;
  for (bool isFlat = false;; isFlat = true)
  {
    const Staying staying = this->staying();
    if (vertices < staying.heldVertices)
    {
      return false;
    }
    // Bodies with held vertices stay; patches with seams between them are one.
    joinSeams(this->Window, staying.locked, this->Polled);
    bodies = smallBodies(this->Window, staying.all(), vertices - staying.heldVertices,
      mayBeFragments(this->Parts.vertices(), this->Parts.cells()), this->Polled);
    separateSeams(this->Window);
    if (isFlat || bodies.number == 0)
    {
      break;
    }
    // Before any goes: flat ones need few vertices.
    const auto most = static_cast<std::size_t>(vertices + staying.lockedVertices);
    this->count(collapseFlat(this->Window, staying.locked, most, this->Polled));
  }
  removeBodies(this->Window, bodies, this->Polled);
  this->Counts.dropped += static_cast<std::int64_t>(bodies.number);
  return bodies.areFragments;
}

/** Collapses edges of the window until it has `vertices` vertices that are not locked. Where no
 * more collapses are possible, a number alone comes before the bodies of a result in parts, too. */
void StreamSimplifier::fit(std::int64_t vertices)
{
  this->collapse(vertices);
  const auto free =
    static_cast<std::int64_t>(this->Window.vertices()) - this->staying().lockedVertices;
  if (this->Streams && this->Goal.vertices > 0 && !this->limitsError() && free > vertices)
  {
    this->dropBodies(vertices);
  }
}

/** Simplifies a window whose result stays in it, to about this number of vertices. If collapses
 * cannot make enough room, vertices are merged by their positions. */
void StreamSimplifier::shrink(std::size_t vertices)
{
  const auto wanted = static_cast<std::int64_t>(vertices);
  if (!this->dropBodies(wanted))
  {
    this->collapse(wanted);
  }
  if (4 * this->Window.triangles() > 3 * this->Capacity)
  {
    const std::size_t before = this->Window.vertices();
    clusterVertices(this->Window, this->staying().held, this->Capacity / 8, this->Polled);
    this->countMerged(before - this->Window.vertices());
  }
}

/** Delivers the older half of the triangles of the window. The age of a triangle is its last vertex
 * in the stream. */
void StreamSimplifier::deliverOlderHalf()
{
  const SurfacePart& window = this->Window;
  std::vector<std::int64_t> ages(window.triangles());
  for (std::size_t t = 0; t < ages.size(); ++t)
  {
    this->Polled.at(t);
    const std::uint32_t* c = window.corners.data() + 3 * t;
    ages[t] = std::max({ window.ids[c[0]], window.ids[c[1]], window.ids[c[2]] });
  }
  std::vector<std::int64_t> sorted = ages;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  std::vector<std::uint8_t> leaves(ages.size());
  std::ranges::transform(
    ages, leaves.begin(), [middle](std::int64_t age) { return age <= *middle ? 1 : 0; });
  this->deliver(leaves);
}

/** Moves triangles of the window to the result; the others stay. Vertices of both are locked from
 * here on, and known to the result as shared until nothing in the window or the stream uses them.
 */
void StreamSimplifier::deliver(const std::vector<std::uint8_t>& leaves)
{
  std::vector<std::uint8_t> stays(this->Window.vertices(), 0);
  std::vector<std::uint32_t> leaving;
  for (std::uint32_t t = 0; t < leaves.size(); ++t)
  {
    this->Polled.at(t);
    if (leaves[t] != 0)
    {
      leaving.push_back(t);
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      stays[this->Window.corners[3 * std::size_t(t) + k]] = 1;
    }
  }
  Result result{ this->Window.extract(leaving, this->Polled), {}, {} };
  this->DeliveredVertices += std::ranges::count_if(
    result.surface.ids, [this](std::int64_t id) { return !this->Delivered.contains(id); });
  // What the window still uses, or later parts may.
  std::unordered_set<std::int64_t> staying;
  for (std::size_t v = 0; v < stays.size(); ++v)
  {
    this->Polled.at(v);
    if (stays[v] != 0 || this->Window.ids[v] >= this->End)
    {
      staying.insert(this->Window.ids[v]);
    }
  }
  for (std::size_t v = 0; v < result.surface.ids.size(); ++v)
  {
    this->Polled.at(v);
    const std::int64_t id = result.surface.ids[v];
    const bool isShared = staying.contains(id);
    this->Counts.held += result.surface.isHeld(v) && !this->Delivered.contains(id) ? 1 : 0;
    result.isShared.push_back(isShared ? 1 : 0);
    if (isShared)
    {
      this->Delivered.insert(id);
    }
  }
  std::erase_if(this->Delivered,
    [&](std::int64_t id)
    {
      const bool hasEnded = !staying.contains(id) && id < this->End;
      if (hasEnded)
      {
        result.ended.push_back(id);
      }
      return hasEnded;
    });
  this->Window.removeTriangles([&leaves](std::size_t t) { return leaves[t] != 0; }, this->Polled);
  this->Window.dropUnusedVertices(this->Polled);
  // Saved before the state that counts it: a program that continues finds all parts of the result.
  if (this->Kept && !this->IsFinished)
  {
    this->keptResult(this->KeptResults++).save(1, [&](StateWriter& state) { state(result); });
  }
  this->Ready.push_back(std::move(result));
}

void StreamSimplifier::finish()
{
  this->IsFinished = true;
  this->Counts.vertices = this->Parts.vertices();
  // No later parts: only delivered vertices are locked.
  this->End = this->Parts.vertices();
  const std::int64_t most =
    std::max<std::int64_t>(0, this->Goal.vertices - this->DeliveredVertices);
  const bool mayDrop = !this->Streams && !this->limitsError() && this->Goal.vertices > 0;
  bool areFragments = false;
  if (mayDrop && this->remaining() > most)
  {
    areFragments = this->dropBodies(most);
  }
  if (!areFragments && (this->Goal.vertices == 0 || this->remaining() > most))
  {
    this->fit(most);
  }
  // Collapses alone leave too many vertices: they are merged by their positions, also those of
  // seams.
  const std::vector<std::uint8_t> held = this->Window.held();
  if (mayDrop && this->remaining() > most && std::ranges::count(held, 1) <= most)
  {
    SurfacePart merged = this->Window;
    clusterVertices(merged, held, static_cast<std::size_t>(most), this->Polled);
    if (merged.triangles() > 0)
    {
      this->countMerged(this->Window.vertices() - merged.vertices());
      this->Window = std::move(merged);
    }
  }
  this->deliver(std::vector<std::uint8_t>(this->Window.triangles(), 1));
}

/** Lists the places of those vertices of the window that later parts may have. */
void StreamSimplifier::renumber()
{
  this->Open.clear();
  for (std::size_t v = 0; v < this->Window.vertices(); ++v)
  {
    this->Polled.at(v);
    if (this->Window.ids[v] >= this->End)
    {
      this->Open.emplace(this->Window.ids[v], static_cast<std::uint32_t>(v));
    }
  }
}

} // namespace smg
