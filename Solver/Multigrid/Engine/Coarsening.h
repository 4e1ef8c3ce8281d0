// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/InterpolationSweeps.h"
#include "Solver/Multigrid/OperatorSet.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "Solver/Multigrid/Setup/RowBatch.h"
#include "smg/Error.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <utility>

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
template <OperatorSet Operators>
class Coarsening
{
public:
  /** `stiff`: finds the stiff rows of the coarse level; `apart`: whether stages may run on
   * several threads. */
  Coarsening(Pool& pool, Operators operators, LevelRows& fine, LevelRows& coarse,
    SliverRows stiff = {}, bool apart = false)
    : Set(std::move(operators))
    , Data(pool, fine, coarse, stiff, apart)
    , Final(pool)
    , Begin(fine.first())
    , CoarseBegin(coarse.first())
    , Sweeps(this->Set.interpolationSweeps(), this->Begin)
  {
    this->Data.patches.setRings(patchRingsOf(this->Set));
  }

  const CoarseningData& data() const { return this->Data; }
  /** The end of the rows of A P: their interpolation and the patches of their neighbours are
   * final. As published to the stages after productAP(). */
  std::int64_t multiplied() const { return this->Multiplied.published(); }
  /** Declares that the rows and the interpolation of nodes below `end` have been copied. */
  void packed(std::int64_t end) { this->Packed = end; }

  /** Advances every stage as far as possible on the existing rows, or on those below `rows`, on
   * one thread. The coarse level gets its new rows by handOver(), so that several levels may
   * advance on different threads. */
  void advance(std::int64_t rows = std::numeric_limits<std::int64_t>::max())
  {
    this->begin(rows);
    this->advanceChoice();
    this->publishInitial();
    this->advanceInterpolation();
    this->publishInterpolation();
    this->advanceProducts();
    this->publishProducts();
    this->advanceGathering();
    this->advanceCoarseRows();
    this->release();
  }

  // The same on five threads: between beginApart() and release(), the five functions below may run
  // at the same time. Each works on what the one before it had done in earlier steps: beginApart()
  // publishes the cursors, and reserves the room that the step will need, so that no ring moves
  // while another thread reads it.

  /** Begins a step in which each stage usually processes at most this number of nodes, see
   * StepLimit. Returns about how many coarse rows these become. */
  std::int64_t beginApart(std::int64_t nodes)
  {
    assert(&this->Data.productSlots != &this->Data.slots); // made for several threads
    const std::int64_t coarse = this->usualCoarseRows(nodes);
    this->Limits.begin(nodes, coarse);
    this->Sweeps.begin(StepLimits::more(nodes));
    this->begin(this->Chosen + this->Limits.choose.nodes());
    std::swap(this->Data.gathered, this->Data.arrived);
    this->publishProducts();
    this->publishInterpolation();
    this->publishInitial();
    this->reserve();
    this->Apart = true;
    return coarse;
  }
  /** The number of rows that no stage has processed. */
  std::int64_t waiting() const { return this->Data.fine.end() - this->Chosen; }

  /** The stages up to the initial P. */
  void advanceChoice()
  {
    this->choose();
    this->interpolateInitial();
  }

  /** The stages from the initial P to P. */
  void advanceInterpolation()
  {
    this->Data.slots.extend(this->Data.publishedCoarse);
    this->interpolate();
  }

  /** The stage from P to A P. */
  void advanceProducts()
  {
    this->Data.productSlots.extend(this->Data.interpolatedCoarse);
    this->productAP();
  }

  /** The stage from A P to P^T A P. */
  void advanceGathering() { this->productPtAP(); }

  /** The stages from P^T A P to the coarse rows. */
  void advanceCoarseRows()
  {
    this->sparsify(this->Data.arrived);
    this->finish();
  }

  /** Appends the new final coarse rows to the coarse level; between two steps. */
  void handOver()
  {
    this->Final.moveTo(this->Data.coarse);
    this->Data.coarse.Ended = this->Data.fine.Ended && this->Chosen == this->Data.fine.end() &&
                              this->Finished == this->Data.coarseNodes;
  }

  /** Releases data that no stage needs any more; between two steps. A node is needed by a stage
   * until that has passed all rows that contain it, which LevelRows::unreached() finds. */
  void release()
  {
    CoarseningData& d = this->Data;
    const LevelRows& rows = d.fine;
    this->RelaxedDone = rows.unreached(this->RelaxedDone, this->Interpolated);
    this->ReachDone = rows.unreached(this->ReachDone, this->Multiplied);
    this->PatchesDone = rows.unreached(this->PatchesDone, this->Packed);
    this->MatricesDone = rows.unreached(this->MatricesDone, this->PatchesDone);
    d.coarseIndex.release(this->RelaxedDone);
    d.initial.release(this->RelaxedDone);
    d.initialTotal.release(this->RelaxedDone);
    d.relaxed.release(this->RelaxedDone);
    d.patches.release(std::min<std::int64_t>(this->PatchesDone, this->Multiplied));
    d.patchMatrices.release(this->MatricesDone);
    while (
      this->ProductDone < this->Multiplied && d.parentReach[this->ProductDone] < this->Gathered)
    {
      ++this->ProductDone;
    }
    d.product.release(this->ProductDone);
    d.productSum.release(this->ProductDone);
    const std::int64_t interpolationDone =
      std::min({ this->ReachDone, this->ProductDone, this->Packed });
    d.interpolation.release(interpolationDone);
    d.rowQuanta.release(interpolationDone);
    d.settledReach.release(this->Packed);
    d.parentReach.release(interpolationDone);
    const std::int64_t nextFine =
      this->Gathered < d.coarseNodes ? d.finePoint[this->Gathered] : this->Chosen;
    d.fine.release(std::min<std::int64_t>(this->Multiplied, this->Packed),
      std::min({ this->RelaxedDone, this->ReachDone, this->MatricesDone, nextFine }));
    d.finePoint.release(this->Gathered);
    d.firstChild.release(this->Gathered);
    d.lastChild.release(this->Finished);
    d.releaseRaw(this->Finished);
    d.releaseSlots(this->Finished);
  }

private:
  /** Lets the stages read the existing rows below `rows`. Refuses a stream order for which a
   * window would have more coarse nodes than entries can distinguish. */
  void begin(std::int64_t rows)
  {
    this->Rows = std::min(rows, this->Data.fine.end());
    if (this->Data.coarseNodes - this->Finished >= CoarseWindow)
    {
      throw Error(
        "neighbours lie too far apart in the stream: convert the mesh with the order bfs");
    }
  }

  /** Publishes the coarse nodes and P0 so far to the stages of advanceInterpolation(). */
  void publishInitial()
  {
    this->Initial.publish();
    this->Data.publishedCoarse = this->Data.coarseNodes;
  }

  /** Publishes P so far to the stages from productAP() on. */
  void publishInterpolation()
  {
    this->Interpolated.publish();
    this->Data.interpolatedCoarse = this->Data.publishedCoarse;
    this->Data.gatherSlots.extend(this->Data.interpolatedCoarse);
    this->Data.sparsifySlots.extend(this->Data.interpolatedCoarse);
  }

  /** Publishes A P so far to the stages from productPtAP() on. */
  void publishProducts() { this->Multiplied.publish(); }

  /** The number of coarse rows that this number of rows becomes, on average so far or as in the
   * last step. */
  std::int64_t usualCoarseRows(std::int64_t rows)
  {
    const std::int64_t chosen = this->Chosen - this->Begin;
    const std::int64_t coarse = this->Data.coarseNodes - this->CoarseBegin;
    const std::int64_t last = coarse - std::exchange(this->CoarseBefore, coarse);
    return std::min(rows, std::max(last, chosen > 0 ? rows * coarse / chosen : rows));
  }

  /** Reserves room for what this step adds to the data that several threads use. Rings grow only
   * here. */
  void reserve()
  {
    CoarseningData& d = this->Data;
    const std::int64_t rows =
      std::min(this->Rows - this->Interpolated, this->Limits.interpolate.nodes());
    const std::int64_t choices = this->Rows - this->Chosen;
    d.coarseIndex.reserve(this->Rows - d.coarseIndex.first());
    d.patches.reserve(choices);
    d.interpolation.reserve(rows, RelaxedRow::Most * rows);
    d.rowQuanta.reserve(this->Interpolated + rows - d.rowQuanta.first());
    d.patchMatrices.reserve(rows, this->PatchEntries.of(rows) + PatchMatrix::Entries);
    d.parentReach.reserve(rows);
    d.finePoint.reserve(choices);
    d.firstChild.reserve(d.coarseNodes + choices - d.firstChild.first());
    d.lastChild.reserve(d.coarseNodes + choices - d.lastChild.first());
    this->reserveInitial();
    this->reserveProducts();
  }

  /** The same for P0: room for rows of the mean length, and for the longest that the next one
   * may be, so that the stage always advances. */
  void reserveInitial()
  {
    CoarseningData& d = this->Data;
    const std::int64_t rows = std::min(this->Rows - this->Initial, this->Limits.initial.nodes());
    if (rows > 0)
    {
      d.initial.reserve(rows, this->InitialEntries.of(rows) + d.maxInitial(this->Initial));
      d.initialTotal.reserve(this->Initial + rows - d.initialTotal.first());
    }
  }

  /** The same for A P. */
  void reserveProducts()
  {
    CoarseningData& d = this->Data;
    const std::int64_t rows =
      std::min(this->Rows - this->Multiplied, this->Limits.productAP.nodes());
    if (rows > 0)
    {
      d.product.reserve(rows, this->ProductEntries.of(rows) + d.maxProducts(this->Multiplied));
      d.productSum.reserve(this->Multiplied + rows - d.productSum.first());
      d.settledReach.reserve(rows);
    }
  }

  void choose()
  {
    CoarseningData& d = this->Data;
    d.coarseIndex.extend(this->Rows);
    this->Limits.choose.run(
      this->Chosen, this->Rows, [&](std::int64_t) { return !(this->Apart && d.patches.isFull()); },
      [&](std::int64_t i)
      {
        // First, since the choice needs the diagonal of the row.
        d.patches.add(d.fine);
        const bool isCoarse = this->Set.isCoarse(d, i);
        d.coarseIndex[i] =
          isCoarse ? CoarseningData::coarseIndexOf(d.coarseNodes) : CoarseningData::FPoint;
        if (isCoarse)
        {
          d.finePoint.append(i);
          ++d.coarseNodes;
        }
      });
    d.firstChild.extend(d.coarseNodes);
    d.lastChild.extend(d.coarseNodes);
  }

  /** P0 of a row needs the choice at all neighbours. */
  void interpolateInitial()
  {
    CoarseningData& d = this->Data;
    this->Limits.initial.run(
      this->Initial, this->Chosen,
      [&](std::int64_t i) {
        return d.fine.reach(i) < this->Chosen &&
               (!this->Apart || d.initial.hasRoom(d.maxInitial(i)));
      },
      [&](std::int64_t i)
      {
        this->Set.interpolateInitial(d, i);
        this->InitialEntries.add(d.initial.size(i));
      });
  }

  /** Sweeps, then the final rows. The matrix of a patch is taken when the row of its first node
   * is final: all its rows exist then, and may be released soon. */
  void interpolate()
  {
    CoarseningData& d = this->Data;
    this->Sweeps.advance(this->Set, d, this->Initial.published());
    this->Limits.interpolate.run(
      this->Interpolated, this->Sweeps.settled(),
      [&](std::int64_t) { return !(this->Apart && d.patchMatrices.isFull()); },
      [&](std::int64_t i)
      {
        d.rowQuanta.extendRaw(i + 1);
        this->Set.interpolate(d, i);
        this->PatchEntries.add(d.appendPatchMatrix(i));
      });
  }

  /** A row of A P needs P of all neighbours. By then the patches of the neighbours are complete,
   * too: their ends are noted for the blocks. */
  void productAP()
  {
    CoarseningData& d = this->Data;
    this->Limits.productAP.run(
      this->Multiplied, this->Rows,
      [&](std::int64_t i)
      {
        return d.fine.reach(i) < this->Interpolated.published() &&
               (!this->Apart || d.product.hasRoom(d.maxProducts(i)));
      },
      [&](std::int64_t i)
      {
        d.productSum.extendRaw(i + 1);
        this->Set.productAP(d, i);
        d.settledReach.append(d.patches.lastAround(d.fine, i));
        this->ProductEntries.add(d.product.size(i));
      });
  }

  /** Whether all children of c and their rows of A P exist. Children lie within two rings of the
   * C-point: once P of these is final, the chain of c is complete. */
  bool canGather(std::int64_t c) const
  {
    const CoarseningData& d = this->Data;
    const std::int64_t ring = d.fine.reach(d.finePoint[c]);
    if (ring >= this->Rows || d.fine.reach(ring) >= this->Interpolated.published())
    {
      return false;
    }
    return d.lastChild[c].row(d.finePoint[c]) < this->Multiplied.published();
  }

  /** Products in the order of coarse nodes. On one thread each row is sparsified at once; apart,
   * the rows of a step wait for the next one. */
  void productPtAP()
  {
    CoarseningData& d = this->Data;
    this->Limits.productPtAP.run(
      this->Gathered, d.interpolatedCoarse, [&](std::int64_t c) { return this->canGather(c); },
      [&](std::int64_t c)
      {
        this->Set.productPtAP(d, c);
        if (!this->Apart)
        {
          this->sparsify(d.gathered);
        }
      });
  }

  /** Sparsifies rows that were gathered. */
  void sparsify(GatheredRows& rows)
  {
    CoarseningData& d = this->Data;
    rows.take(
      [&](const GatheredRow& row, const CoarseEntry* entries)
      {
        d.appendRaw(this->Sparsified, row, entries);
        this->Set.sparsify(d, this->Sparsified++);
      });
  }

  /** A coarse row is final when its last neighbour was sparsified: later rows do not change its
   * entries. */
  void finish()
  {
    CoarseningData& d = this->Data;
    for (std::int64_t& c = this->Finished; c < this->Sparsified; ++c)
    {
      const std::int64_t size = d.raw.size(c);
      if (size > 0 && c + d.raw.row(c)[size - 1].offset(c) >= this->Sparsified)
      {
        break;
      }
      finishRow(d, c, d.lastChild[c].row(this->Rows), this->Final);
    }
  }

  Operators Set;
  CoarseningData Data;
  RowBatch Final;
  StepLimits Limits;
  bool Apart = false; // whether several threads advance the stages

  std::int64_t CoarseBefore = 0;         // coarse nodes a step ago
  const std::int64_t Begin, CoarseBegin; // the first nodes
  std::int64_t Rows = Begin;             // end of the rows of the fine level that stages may read
  std::int64_t Chosen = Begin;           // by fine node
  Cursor Initial{ Begin };
  InterpolationSweeps<Operators> Sweeps;
  Cursor Interpolated{ Begin }, Multiplied{ Begin };
  MeanRowLength InitialEntries, PatchEntries, ProductEntries;
  // By coarse node.
  std::int64_t Gathered = CoarseBegin, Sparsified = CoarseBegin, Finished = CoarseBegin;
  std::int64_t Packed = Begin, ProductDone = Begin;
  std::int64_t RelaxedDone = Begin, ReachDone = Begin, PatchesDone = Begin, MatricesDone = Begin;
};

} // namespace smg
