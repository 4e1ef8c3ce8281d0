// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Schedule/Cursor.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "Solver/Multigrid/Setup/RowBatch.h"
#include "smg/Export.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace smg
{

/** The mean number of entries of rows, from which room is reserved. On a cache line of its own,
 * since stages on different threads update theirs at the same time. */
class alignas(64) MeanRowLength
{
public:
  /** Counts a row with this number of entries. */
  void add(std::int64_t entries)
  {
    ++this->Rows;
    this->Entries += entries;
  }

  /** Somewhat more entries than this number of rows had on average so far. */
  std::int64_t of(std::int64_t rows) const
  {
    constexpr std::int64_t AtFirst = 8;
    const std::int64_t usual = this->Rows > 0 ? rows * this->Entries / this->Rows : AtFirst * rows;
    return usual + usual / 8;
  }

private:
  std::int64_t Rows = 0, Entries = 0;
};

/**
 * The number of nodes that a stage may process in a step of several concurrent stages. A step lasts
 * as long as its longest stage, so a stage that gets many nodes at once distributes them over
 * several steps. While it cannot keep up, its limit grows from step to step, so that what waits for
 * it stays a small multiple of what it got at once.
 */
class StepLimit
{
public:
  /** Begins a step of usually at most this number of nodes; a few are permitted in any case. */
  void begin(std::int64_t nodes)
  {
    constexpr std::int64_t Least = 16;
    nodes = std::max(nodes, Least);
    this->Most = this->Reached ? std::max(nodes, this->Most + this->Most / 4) : nodes;
    this->Reached = false;
  }
  std::int64_t nodes() const { return this->Most; }

  /** Calls work(i) for i from `next` on, as long as i is below `end`, may(i) is true, and the
   * step permits it. */
  template <class May, class Work>
  void run(std::int64_t& next, std::int64_t end, May&& may, Work&& work)
  {
    const std::int64_t limit = next + this->Most;
    // Cursors of stages on other threads share the cache line: this one is stored once, not for
    // each node.
    std::int64_t at = next;
    for (end = std::min(end, limit); at < end && may(at); ++at)
    {
      work(at);
    }
    next = at;
    this->Reached = next == limit;
  }

  /** The same for the cursor of a stage. */
  template <class May, class Work>
  void run(Cursor& next, std::int64_t end, May&& may, Work&& work)
  {
    std::int64_t at = next;
    this->run(at, end, may, work);
    next = at;
  }

private:
  std::int64_t Most = std::int64_t(1) << 62; // no limit
  bool Reached = false;
};

/** The limits of the stages of a coarsening, except for the sweeps. */
struct StepLimits
{
  StepLimit choose, initial, interpolate, productAP, productPtAP;

  /** A few more nodes than the stages get on average, so that they catch up. */
  static std::int64_t more(std::int64_t nodes) { return nodes + nodes / 16; }

  /** Begins a step of this number of nodes, which become that number of coarse ones. */
  void begin(std::int64_t nodes, std::int64_t coarse)
  {
    this->choose.begin(nodes);
    for (StepLimit* limit : { &this->initial, &this->interpolate, &this->productAP })
    {
      limit->begin(more(nodes));
    }
    this->productPtAP.begin(more(coarse));
  }
};

/**
 * Builds a level from the next finer one, as far as the rows of that exist. The stages are those of
 * the operator set (OperatorSet), each with a cursor, the next node to process:
 *
 *   choose              needs the row of i,
 *   interpolateInitial  the choice at all neighbours,
 *   relaxInterpolation  P0, or the rows of the sweep before, of all neighbours,
 *   interpolate         row i from the last sweep, with its patch,
 *   productAP           P of all neighbours,
 *   productPtAP         by coarse node: the final list of its children, and their rows of A P,
 *   sparsify            the product rows up to this one,
 *   finish              the sparsification of all neighbours.
 *
 * A stage may process a node when the stages before it have passed the largest index that the node
 * needs; all these bounds are monotone, so comparing cursors suffices. Data that no stage needs any
 * more are released. Every step reads only what its bound guarantees, so the coarse level is the
 * same for any number of rows at a time and any number of threads.
 *
 * The windows of the stages follow each other within a few rings of the stream: the memory is
 * proportional to the span of the stream order. Nodes are numbered from the first rows of the two
 * levels on.
 */
class SMG_EXPORT LevelCoarsening
{
public:
  LevelCoarsening(Pool& pool, LevelRows& fine, LevelRows& coarse, SliverRows stiff, bool pipelined,
    int patchRings);
  virtual ~LevelCoarsening() = default;
  LevelCoarsening(const LevelCoarsening&) = delete;
  LevelCoarsening& operator=(const LevelCoarsening&) = delete;

  const CoarseningData& data() const { return this->Data; }
  /** Lets the stages end when the answer is no; it must outlive this. */
  void setCheck(CancelCheck& check) { this->Data.check = &check; }
  /** The end of the rows of A P: their interpolation and the patches of their neighbours are
   * final. As published to the stages after productAP(). */
  std::int64_t multiplied() const { return this->Multiplied.published(); }
  // Between two steps, for traces: the next node of the stages up to the initial P, of P, A P and
  // P^T A P, and the next coarse row.
  std::int64_t atInitial() const { return this->Initial; }
  std::int64_t atInterpolation() const { return this->Interpolated; }
  std::int64_t atProduct() const { return this->Multiplied; }
  std::int64_t atGathering() const { return this->Gathered; }
  std::int64_t atFinish() const { return this->Finished; }
  /** Declares that the rows and the interpolation of nodes below `end` have been copied. */
  void packed(std::int64_t end) { this->Packed = end; }

  /** Advances every stage as far as possible on the existing rows, or on those below `rows`, on
   * one thread. The coarse level gets its new rows by handOver(), so that several levels may
   * advance on different threads. */
  void advance(std::int64_t rows = std::numeric_limits<std::int64_t>::max());

  // The same on five threads: between beginPipelined() and release(), the five functions below may
  // run at the same time. Each works on what the one before it had done in earlier steps:
  // beginPipelined() publishes the cursors, and reserves the room that the step will need, so that
  // no ring moves while another thread reads it.

  /** Begins a step in which each stage usually processes at most this number of nodes, see
   * StepLimit. Returns about how many coarse rows these become. */
  std::int64_t beginPipelined(std::int64_t nodes);
  /** The number of rows that no stage has processed. */
  std::int64_t waiting() const { return this->Data.fine.end() - this->Chosen; }

  /** The stages up to the initial P. */
  virtual void advanceChoice() = 0;
  /** The stages from the initial P to P. */
  virtual void advanceInterpolation() = 0;
  /** The stage from P to A P. */
  virtual void advanceProducts() = 0;
  /** The stage from A P to P^T A P. */
  virtual void advanceGathering() = 0;
  /** The stages from P^T A P to the coarse rows. */
  virtual void advanceCoarseRows() = 0;

  /** Appends the new final coarse rows to the coarse level; between two steps. */
  void handOver();
  /** Releases data that no stage needs any more; between two steps. A node is needed by a stage
   * until that has passed all rows that contain it, which LevelRows::unreached() finds. */
  void release();

protected:
  /** Begins a step in which each sweep of the interpolation usually relaxes this many rows. */
  virtual void limitSweeps(std::int64_t rows) = 0;
  /** Whether all children of c and their rows of A P exist. Children lie within two rings of the
   * C-point: once P of these is final, the chain of c is complete. */
  bool canGather(std::int64_t c) const;
  /** A coarse row is final when its last neighbour was sparsified: later rows do not change its
   * entries. */
  void finish();

  CoarseningData Data;
  StepLimits Limits;
  bool Pipelined = false; // whether several threads advance the stages

  const std::int64_t Begin, CoarseBegin; // the first nodes
  std::int64_t Rows = Begin;             // end of the rows of the fine level that stages may read
  std::int64_t Chosen = Begin;           // by fine node
  Cursor Initial{ Begin }, Interpolated{ Begin }, Multiplied{ Begin };
  std::int64_t Gathered = CoarseBegin, Sparsified = CoarseBegin; // by coarse node
  MeanRowLength InitialEntries, PatchEntries, OverlappingEntries, ProductEntries;

private:
  void begin(std::int64_t rows);
  void publishInitial();
  void publishInterpolation();
  std::int64_t usualCoarseRows(std::int64_t rows);
  void reserve();
  void reserveInitial();
  void reserveProducts();

  RowBatch Final;
  std::int64_t CoarseBefore = 0; // coarse nodes a step ago
  std::int64_t Finished = CoarseBegin;
  std::int64_t Packed = Begin, ProductDone = Begin;
  std::int64_t RelaxedDone = Begin, ReachDone = Begin, PatchesDone = Begin, MatricesDone = Begin;
};

} // namespace smg
