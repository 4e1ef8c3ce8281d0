// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/EdgeCollapse.h"
#include "IO/Simplification/SurfaceParts.h"
#include "Solver/Checkpoint/Checkpoint.h"
#include "Solver/Core/Progress.h"
#include "Solver/Core/Workers.h"
#include "Solver/Memory/Pool.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Simplify.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace smg
{

/** What a simplification did. */
struct SimplificationCounts
{
  std::int64_t vertices = 0;   ///< that were read
  double error = 0.0;          ///< the largest of a collapse, see collapseEdges()
  std::int64_t dropped = 0;    ///< small bodies
  std::int64_t held = 0;       ///< vertices of the result
  std::int64_t merged = 0;     ///< vertices, where edges could not be collapsed
  bool crossesBorders = false; ///< whether borders between labels were given up
  std::int64_t welded = 0;     ///< vertices on seams, see weldSeams()
  bool turns = false;          ///< whether triangles might turn over
  bool splitsSeams = false;    ///< whether seams were given up, see joinSeams()
  std::int64_t resumedAt = 0;  ///< vertices simplified by an earlier program, see keepIn()
};

/**
 * Simplifies a stream of triangles by edge collapse in bounded memory.
 *
 * Parts of the stream are simplified to an eighth on all threads, with those vertices locked that
 * other parts have, and appended to a window. When that is full it is simplified as a whole, with
 * those of its vertices locked that later parts have, so that no edge between parts remains. A
 * result that fits into the window stays there until the end, when all of it is simplified to the
 * goal; of a larger one, the older half leaves the window whenever that is full.
 *
 * Seams are joined wherever all vertices at a place are in a part or in the window; until then
 * these are held. If the window has no room for so many, seams are given up.
 *
 * Of a surface with very many bodies the smallest are left out, so that the vertices of the result
 * are enough for 20 of each body, or all that it has; of a result that does not fit into the window
 * only where collapses do not suffice.
 *
 * The result depends on the memory and on the blocks of the stream, but not on threads. Every
 * triangle is simplified once in a part, and about twice in the window.
 */
class SMG_EXPORT StreamSimplifier
{
public:
  /** A part of the result, in the order of the stream. */
  struct Result
  {
    SurfacePart surface;
    std::vector<std::uint8_t> isShared; ///< of each vertex: whether later parts may have it
    std::vector<std::int64_t> ended;    ///< vertices of earlier parts that later ones do not have

    template <class State>
    void exchange(State& state)
    {
      state(this->surface, this->isShared, this->ended);
    }
  };

  /** `triangles` and `workers` must outlive it; `marksHeld`: whether their last column of the
   * vertices, of one byte, says which are held or on seams (HeldMesh); `progress` receives the
   * share of the stream that was read, and may throw. A result of more than a third of what fits
   * into `memory`, in bytes, needs the number of vertices. */
  StreamSimplifier(MeshSource& triangles, bool marksHeld, const SimplifyTarget& target,
    std::int64_t memory, Workers& workers, std::function<void(double)> progress);
  ~StreamSimplifier();
  StreamSimplifier(const StreamSimplifier&) = delete;
  StreamSimplifier& operator=(const StreamSimplifier&) = delete;

  /** To be called before next(): saves the state in a kept folder, which must outlive this
   * object, whenever the window has been simplified. A simplification of the same subject that
   * has its state there is continued: the stream is read from its beginning, but not
   * simplified once more. */
  void keepIn(ScratchFolder& folder, std::vector<Checkpoint::Item> subject);

  /** Replaces `result` by the next part of the result; returns whether there is one. Throws Error
   * if the memory does not suffice. */
  bool next(Result& result);

  const SimplificationCounts& counts() const { return this->Counts; }
  std::int64_t peakMemory() const { return this->Memory.peak(); }
  /** The share of the area of the stream that the result has; 1 if that has none. */
  double shareOfArea() const { return this->Parts.shareOfArea(); }
  /** The labels of the cells that were read. */
  const CellLabels& labels() const { return this->Parts.labels(); }
  /** Asks whether to go on, for work on a part of the result. */
  const Poll& polled() const { return this->Polled; }

private:
  struct Item
  {
    StreamPart part;
    double share = 1.0; ///< of its vertices that is left
    Collapsed done;
  };

  /** The share of the vertices of the stream that is in the window or delivered; 0 if their number
   * is not known. */
  double done() const;
  void ask() noexcept;
  void poll();
  bool limitsError() const { return std::isfinite(this->Goal.error); }
  /** The vertices of the result that are aimed at before the end, so that the last window is not
   * left without any: less than the goal, but by no more than has to go. So all stay where all are
   * asked for. */
  double aim() const
  {
    constexpr double Aim = 0.98;
    const auto goal = static_cast<double>(this->Goal.vertices);
    const double surplus = std::max(0.0, static_cast<double>(this->Info.vertices) - goal);
    return this->Info.vertices > 0 ? std::max(Aim * goal, goal - surplus) : Aim * goal;
  }
  void step();
  double shareOfPart() const;
  void append(const StreamPart& part);
  /** The vertices of the window that do not go. */
  struct Staying
  {
    /** Those that later parts, or parts of the result that were delivered, have. */
    std::vector<std::uint8_t> locked;
    /** Those that are held, see heldVertices(). */
    std::vector<std::uint8_t> held;
    std::int64_t lockedVertices = 0;
    std::int64_t heldVertices = 0; ///< that are not locked

    std::vector<std::uint8_t> all() const;
  };
  Staying staying() const;
  bool grow();
  bool hasSeams() const;
  void enlarge(std::size_t capacity);
  void makeRoom();
  void collapse(std::int64_t vertices);
  void count(const Collapsed& done);
  void countMerged(std::size_t vertices)
  {
    this->Counts.crossesBorders = this->Counts.crossesBorders || this->Window.hasBorders();
    this->Counts.merged += static_cast<std::int64_t>(vertices);
  }
  bool dropBodies(std::int64_t vertices);
  void fit(std::int64_t vertices);
  void shrink(std::size_t vertices);
  void deliverOlderHalf();
  void deliver(const std::vector<std::uint8_t>& leaves);
  void finish();
  /** The vertices of the window that were not delivered yet. */
  std::int64_t remaining() const
  {
    return std::ranges::count_if(
      this->Window.ids, [this](std::int64_t id) { return !this->Delivered.contains(id); });
  }
  void renumber();
  Checkpoint keptResult(std::int64_t number) const;
  void save();
  void loadResult(std::int64_t number, Result& result);
  template <class State>
  void exchange(State& state);

  Pool Memory;
  std::function<void(double)> Told;
  std::atomic<bool> IsCancelled{ false };
  Poll Polled;
  SurfaceParts Parts;
  const StreamInfo& Info;
  SimplifyTarget Goal;    ///< an error of 0 has become infinity
  std::size_t Capacity;   ///< of the window, triangles
  std::int64_t Triangles; ///< of the result, as far as it is known
  bool Streams;           ///< whether the result does not fit into the window
  OrderedJobs<Item> Jobs;
  SurfacePart Window;
  std::unordered_map<std::int64_t, std::uint32_t> Open; ///< places of vertices of later parts
  std::unordered_set<std::int64_t> Delivered;           ///< vertices that the window still uses
  std::int64_t End = 0; ///< later parts have no triangles at the vertices below
  std::int64_t DeliveredVertices = 0;
  std::int64_t TakenVertices = 0; ///< of the parts that were appended
  std::int64_t TakenParts = 0, FullWindows = 0;
  std::deque<Result> Ready;
  bool IsFinished = false;
  SimplificationCounts Counts;
  // Of a checkpoint, which has the parts of the result in states of their own.
  ScratchFolder* Folder = nullptr;
  std::vector<Checkpoint::Item> Subject;
  std::optional<Checkpoint> Kept;
  std::int64_t KeptResults = 0, ResumedResults = 0, Replayed = 0;
};

// What simplifications and previews say of their results.

/** Says how many bodies are left out. */
void noteBodies(const StreamSimplifier& simplifier, std::vector<std::string>& notes);

/** Says how many vertices were merged, and where area is lost by that, or by triangles that turn
 * over. `coincide`: whether there are points that could be joined. */
void noteShape(const StreamSimplifier& simplifier, bool coincide, std::vector<std::string>& notes);

} // namespace smg
