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

/** The number of entries that rows of any length usually have. On a cache line of its own, since
 * stages on different threads note theirs at the same time. */
class alignas(64) MeanRowLength
{
public:
  /** Notes a row with so many entries. */
  void add(std::int64_t entries)
  {
    ++this->Rows;
    this->Entries += entries;
  }

  /** Some more than so many rows had on average so far. */
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
 * Builds a level from the next finer one, as far as the rows of that exist. Every stage has a
 * cursor, the next node to process; it may process a node when the stages it depends on have passed
 * the largest index that the node needs. Data that no stage needs any more are released. Nodes are
 * numbered from the first rows of the two levels on.
 */
template <OperatorSet Operators>
class Coarsening
{
public:
  /** `stiff`: those of the coarse level; `apart`: whether stages may run on several threads. */
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
  /** Rows with final interpolation and neighbours' patches, as seen by the stages after it. */
  std::int64_t multiplied() const { return this->SeenProducts; }
  /** Declares that the rows and the interpolation of nodes below `end` have been copied. */
  void packed(std::int64_t end) { this->Packed = end; }

  /**
   * Advances every stage as far as possible on the existing rows, or on those below `rows`. The
   * coarse level gets its new rows by handOver(), so several levels may advance on different
   * threads.
   */
  void advance(std::int64_t rows = std::numeric_limits<std::int64_t>::max())
  {
    this->begin(rows);
    this->advanceLifting();
    this->seeLifting();
    this->advanceInterpolation();
    this->seeInterpolation();
    this->advanceProducts();
    this->seeProducts();
    this->advanceGathering();
    this->advanceCoarseRows();
    this->release();
  }

  // The same on five threads: between beginApart() and release(), the following may run at the same
  // time, each on what the one before it has done in earlier steps.

  /** Begins a step in which stages usually process so many nodes at most, see StepLimit; returns
   * about how many coarse rows these become. */
  std::int64_t beginApart(std::int64_t nodes)
  {
    assert(&this->Data.productSlots != &this->Data.slots); // made for it
    const std::int64_t coarse = this->usualCoarseRows(nodes);
    this->Limits.begin(nodes, coarse);
    this->Sweeps.begin(StepLimits::more(nodes));
    this->begin(this->Chosen + this->Limits.choose.nodes());
    std::swap(this->Data.gathered, this->Data.arrived);
    this->seeProducts();
    this->seeInterpolation();
    this->seeLifting();
    this->reserve();
    this->Apart = true;
    return coarse;
  }
  /** The rows that no stage has processed. */
  std::int64_t waiting() const { return this->Data.fine.end() - this->Chosen; }

  /** The stages up to the initial P. */
  void advanceLifting()
  {
    this->choose();
    this->interpolateInitial();
  }

  /** The stages from the initial P to P. */
  void advanceInterpolation()
  {
    this->Data.slots.extend(this->Data.seenCoarse);
    this->interpolate();
  }

  /** The stage from P to A P. */
  void advanceProducts()
  {
    this->Data.productSlots.extend(this->Data.knownCoarse);
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

  /** Appends the new final coarse rows to the coarse level. */
  void handOver()
  {
    this->Final.moveTo(this->Data.coarse);
    this->Data.coarse.Ended = this->Data.fine.Ended && this->Chosen == this->Data.fine.end() &&
                              this->Finished == this->Data.coarseNodes;
  }

  /** Releases data that no stage needs any more. */
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
    d.patches.release(std::min(this->PatchesDone, this->Multiplied));
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
    d.fine.release(std::min(this->Multiplied, this->Packed),
      std::min({ this->RelaxedDone, this->ReachDone, this->MatricesDone, nextFine }));
    d.finePoint.release(this->Gathered);
    d.firstChild.release(this->Gathered);
    d.lastChild.release(this->Finished);
    d.releaseRaw(this->Finished);
    d.releaseSlots(this->Finished);
  }

private:
  /** Lets the stages read the existing rows below `rows`. */
  void begin(std::int64_t rows)
  {
    this->Rows = std::min(rows, this->Data.fine.end());
    if (this->Data.coarseNodes - this->Finished >= CoarseWindow)
    {
      throw Error(
        "neighbours lie too far apart in the stream: convert the mesh with the order bfs");
    }
  }

  /** Shows the coarse nodes and the initial P so far to the stages of advanceInterpolation(). */
  void seeLifting()
  {
    this->SeenInitial = this->Initial;
    this->Data.seenCoarse = this->Data.coarseNodes;
  }

  /** Shows the interpolation so far to the stages from productAP() on. */
  void seeInterpolation()
  {
    this->Seen = this->Interpolated;
    this->Data.knownCoarse = this->Data.seenCoarse;
    this->Data.gatherSlots.extend(this->Data.knownCoarse);
    this->Data.sparsifySlots.extend(this->Data.knownCoarse);
  }

  /** Shows the products so far to the stages from productPtAP() on. */
  void seeProducts() { this->SeenProducts = this->Multiplied; }

  /** The coarse rows that so many rows become, on average so far or in the last step. */
  std::int64_t usualCoarseRows(std::int64_t rows)
  {
    const std::int64_t chosen = this->Chosen - this->Begin;
    const std::int64_t coarse = this->Data.coarseNodes - this->CoarseBegin;
    const std::int64_t last = coarse - std::exchange(this->CoarseBefore, coarse);
    return std::min(rows, std::max(last, chosen > 0 ? rows * coarse / chosen : rows));
  }

  /** Makes room for what this step adds to the data that several threads use. */
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

  /** Of the initial rows, too, which are as long as those of the level at most. */
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

  /** The rows of A P are of any length: there is room for rows of the usual one. */
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

  void interpolate()
  {
    CoarseningData& d = this->Data;
    this->Sweeps.advance(this->Set, d, this->SeenInitial);
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

  void productAP()
  {
    CoarseningData& d = this->Data;
    this->Limits.productAP.run(
      this->Multiplied, this->Rows,
      [&](std::int64_t i) {
        return d.fine.reach(i) < this->Seen &&
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

  /** Whether all children of c, which lie within two rings of it, and their products exist. */
  bool canGather(std::int64_t c) const
  {
    const CoarseningData& d = this->Data;
    const std::int64_t ring = d.fine.reach(d.finePoint[c]);
    if (ring >= this->Rows || d.fine.reach(ring) >= this->Seen)
    {
      return false;
    }
    return d.lastChild[c].row(d.finePoint[c]) < this->SeenProducts;
  }

  void productPtAP()
  {
    CoarseningData& d = this->Data;
    this->Limits.productPtAP.run(
      this->Gathered, d.knownCoarse, [&](std::int64_t c) { return this->canGather(c); },
      [&](std::int64_t c)
      {
        this->Set.productPtAP(d, c);
        if (!this->Apart)
        {
          this->sparsify(d.gathered);
        }
      });
  }

  /** Processes rows that have been gathered. */
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

  /** A coarse row is final when its last neighbour has been processed. */
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
  std::int64_t Rows = Begin;             // of the fine level, that stages may read
  std::int64_t Chosen = Begin, Initial = Begin, SeenInitial = Begin; // by fine node
  InterpolationSweeps<Operators> Sweeps;
  std::int64_t Interpolated = Begin, Seen = Begin, Multiplied = Begin, SeenProducts = Begin;
  MeanRowLength InitialEntries, PatchEntries, ProductEntries;
  // By coarse node.
  std::int64_t Gathered = CoarseBegin, Sparsified = CoarseBegin, Finished = CoarseBegin;
  std::int64_t Packed = Begin, ProductDone = Begin;
  std::int64_t RelaxedDone = Begin, ReachDone = Begin, PatchesDone = Begin, MatricesDone = Begin;
};

} // namespace smg
