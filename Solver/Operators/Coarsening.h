// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/CoarseningData.h"
#include "Solver/Hierarchy/RowBatch.h"
#include "Solver/Operators/OperatorSet.h"
#include "Solver/Operators/StepLimit.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace smg
{

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
  /** `stiff`: those of the coarse level. */
  Coarsening(
    Pool& pool, Operators operators, LevelRows& fine, LevelRows& coarse, StiffRows stiff = {})
    : Set(std::move(operators))
    , Data(pool, fine, coarse, stiff)
    , Begin(fine.first())
    , CoarseBegin(coarse.first())
    , Relaxed(static_cast<std::size_t>(this->Set.interpolationSweeps()),
        Sweep{ this->Begin, this->Begin, {} })
  {
  }

  const CoarseningData& data() const { return this->Data; }
  /** Rows of P that are final, as the stages from multiply() on see it. */
  std::int64_t interpolated() const { return this->Seen; }
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
    this->advanceInterpolation();
    this->seeInterpolation();
    this->advanceProducts();
    this->seeProducts();
    this->advanceCoarseRows();
    this->release();
  }

  // The same on three threads: between beginApart() and release(), advanceInterpolation(),
  // advanceProducts() and advanceCoarseRows() may run at the same time, each on what the one before
  // it has done in earlier steps.

  /** Begins a step in which stages usually process so many nodes at most, see StepLimit; returns
   * about how many coarse rows these become. */
  std::int64_t beginApart(std::int64_t nodes)
  {
    const std::int64_t coarse = this->usualCoarseRows(nodes);
    this->Limits.begin(nodes, coarse);
    for (Sweep& sweep : this->Relaxed)
    {
      sweep.limit.begin(StepLimits::more(nodes));
    }
    this->begin(this->Lifted + this->Limits.lift.nodes());
    this->seeProducts();
    this->seeInterpolation();
    this->reserve();
    this->Apart = true;
    return coarse;
  }
  /** The rows that no stage has processed. */
  std::int64_t waiting() const { return this->Data.fine.end() - this->Lifted; }

  /** The stages that determine P. */
  void advanceInterpolation()
  {
    this->lift();
    this->interpolate();
  }

  /** The stage from P to A P. */
  void advanceProducts()
  {
    this->Data.productSlots.extend(this->Data.knownCoarse);
    this->multiply();
  }

  /** The stages from A P to the coarse rows. */
  void advanceCoarseRows()
  {
    this->Data.gatherSlots.extend(this->Data.knownCoarse);
    this->gather();
    this->finish();
  }

  /** Appends the new final coarse rows to the coarse level. */
  void handOver()
  {
    this->Final.moveTo(this->Data.coarse);
    this->Data.coarse.Ended = this->Data.fine.Ended && this->Lifted == this->Data.fine.end() &&
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
    d.lifted.release(this->RelaxedDone);
    d.initial.release(this->RelaxedDone);
    d.initialSum.release(this->RelaxedDone);
    d.relaxed.release(this->RelaxedDone);
    d.patches.release(std::min(this->PatchesDone, this->Multiplied));
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
      this->Gathered < d.coarseNodes ? d.liftedFrom[this->Gathered] : this->Lifted;
    d.fine.release(std::min(this->Multiplied, this->Packed),
      std::min({ this->RelaxedDone, this->ReachDone, this->PatchesDone, nextFine }));
    d.liftedFrom.release(this->Gathered);
    d.firstChild.release(this->Gathered);
    d.lastChild.release(this->Finished);
    d.releaseRaw(this->Finished);
    d.slots.release(this->Finished);
    d.productSlots.release(this->Finished);
    d.gatherSlots.release(this->Finished);
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

  /** Shows the interpolation so far to the stages from multiply() on. */
  void seeInterpolation()
  {
    this->Seen = this->Interpolated;
    this->Data.knownCoarse = this->Data.coarseNodes;
  }

  /** Shows the products so far to the stages from gather() on. */
  void seeProducts() { this->SeenProducts = this->Multiplied; }

  /** The coarse rows that so many rows become, on average so far or in the last step. */
  std::int64_t usualCoarseRows(std::int64_t rows)
  {
    const std::int64_t lifted = this->Lifted - this->Begin;
    const std::int64_t coarse = this->Data.coarseNodes - this->CoarseBegin;
    const std::int64_t last = coarse - std::exchange(this->CoarseBefore, coarse);
    return std::min(rows, std::max(last, lifted > 0 ? rows * coarse / lifted : rows));
  }

  /** Makes room for what this step adds to the data that several threads use. */
  void reserve()
  {
    CoarseningData& d = this->Data;
    const std::int64_t rows =
      std::min(this->Rows - this->Interpolated, this->Limits.interpolate.nodes());
    const std::int64_t lifts = this->Rows - this->Lifted;
    d.patches.reserve(lifts);
    d.interpolation.reserve(rows, RelaxedRow::Most * rows);
    d.rowQuanta.reserve(this->Rows - d.rowQuanta.first());
    d.parentReach.reserve(rows);
    d.settledReach.reserve(rows);
    d.liftedFrom.reserve(lifts);
    for (auto* ring : { &d.firstChild, &d.lastChild })
    {
      ring->reserve(d.coarseNodes + lifts - ring->first());
    }
    this->reserveProducts();
  }

  /** The rows of A P are of any length: there is room for rows of the usual one. */
  void reserveProducts()
  {
    CoarseningData& d = this->Data;
    const std::int64_t rows =
      std::min(this->Rows - this->Multiplied, this->Limits.multiply.nodes());
    if (rows > 0)
    {
      const std::int64_t before = this->Multiplied - this->Begin;
      const std::int64_t usual = before > 0 ? rows * this->ProductEntries / before : 8 * rows;
      d.product.reserve(rows, usual + usual / 8 + this->mostProducts(this->Multiplied));
      d.productSum.reserve(this->Rows - d.productSum.first());
    }
  }

  /** An upper bound of the entries of row i of A P. */
  std::int64_t mostProducts(std::int64_t i) const
  {
    const auto neighbours = static_cast<std::int64_t>(this->Data.fine.row(i).size());
    return RelaxedRow::Most * (neighbours + 1);
  }

  void lift()
  {
    CoarseningData& d = this->Data;
    d.lifted.extend(this->Rows);
    this->Limits.lift.run(
      this->Lifted, this->Rows, [&](std::int64_t) { return !(this->Apart && d.patches.isFull()); },
      [&](std::int64_t i)
      {
        d.patches.add(d.fine);
        const bool lifted = this->Set.lift(d, i);
        d.lifted[i] = lifted ? CoarseningData::liftedTo(d.coarseNodes) : CoarseningData::Retained;
        if (lifted)
        {
          d.liftedFrom.append(i);
          ++d.coarseNodes;
        }
      });
    d.firstChild.extend(d.coarseNodes);
    d.lastChild.extend(d.coarseNodes);
    d.slots.extend(d.coarseNodes);
  }

  void interpolate()
  {
    CoarseningData& d = this->Data;
    const std::int64_t rows = this->Lifted;
    this->Limits.initial.run(
      this->Initial, rows, [&](std::int64_t i) { return d.fine.reach(i) < this->Lifted; },
      [&](std::int64_t i) { this->Set.interpolateInitial(d, i); });
    this->relax();
    d.rowQuanta.extendRaw(rows);
    this->Limits.interpolate.run(
      this->Interpolated, this->Relaxed.back().settled, [](std::int64_t) { return true; },
      [&](std::int64_t i)
      {
        this->Set.interpolate(d, i);
        d.settledReach.append(d.patches.lastAround(d.fine, i));
      });
  }

  /** The sweeps over the rows of P, one after the other. */
  void relax()
  {
    CoarseningData& d = this->Data;
    std::int64_t before = this->Initial;
    for (Sweep& sweep : this->Relaxed)
    {
      sweep.limit.run(
        sweep.next, this->Lifted, [&](std::int64_t i) { return d.fine.reach(i) < before; },
        [&](std::int64_t i)
        {
          if (i == d.relaxed.end())
          {
            d.relaxed.extendRaw(i + 1);
            d.relaxed[i].size = RelaxedRow::Pending;
          }
          this->Set.relaxInterpolation(d, i);
        });
      // A patch is relaxed at its last node.
      while (sweep.settled < sweep.next && d.patches.last(sweep.settled) < sweep.next)
      {
        ++sweep.settled;
      }
      before = sweep.settled;
    }
  }

  void multiply()
  {
    CoarseningData& d = this->Data;
    d.productSum.extendRaw(this->Rows);
    this->Limits.multiply.run(
      this->Multiplied, this->Rows,
      [&](std::int64_t i)
      {
        return d.fine.reach(i) < this->Seen &&
               (!this->Apart || d.product.hasRoom(this->mostProducts(i)));
      },
      [&](std::int64_t i)
      {
        this->Set.multiply(d, i);
        this->ProductEntries += d.product.size(i);
      });
  }

  /** Whether all children of c, which lie within two rings of it, and their products exist. */
  bool canGather(std::int64_t c) const
  {
    const CoarseningData& d = this->Data;
    const std::int64_t ring = d.fine.reach(d.liftedFrom[c]);
    if (ring >= this->Rows || d.fine.reach(ring) >= this->Seen)
    {
      return false;
    }
    return d.lastChild[c].row(d.liftedFrom[c]) < this->SeenProducts;
  }

  void gather()
  {
    CoarseningData& d = this->Data;
    this->Limits.gather.run(
      this->Gathered, d.knownCoarse, [&](std::int64_t c) { return this->canGather(c); },
      [&](std::int64_t c)
      {
        d.openRaw(c + 1);
        this->Set.gather(d, c);
        this->Set.sparsify(d, c);
      });
  }

  /**
   * A coarse row is final when its last neighbour has been processed. Its upper weights are then
   * copied to the lower parts of the rows above it: to the next entry of each, since rows become
   * final in order.
   */
  void finish()
  {
    CoarseningData& d = this->Data;
    for (std::int64_t& c = this->Finished; c < this->Gathered; ++c)
    {
      const std::int64_t size = d.raw.size(c);
      const CoarseEntry* raw = d.raw.row(c);
      std::int32_t* settled = d.rawSettled.at(c);
      if (size > 0 && c + raw[size - 1].offset(c) >= this->Gathered)
      {
        break;
      }
      for (std::int64_t e = d.rawLower[c]; e < size; ++e)
      {
        const std::int32_t delta = raw[e].offset(c);
        d.raw.row(c + delta)[settled[delta]++].takeValue(raw[e]);
      }
      RowEntry* out = this->Final.open(size);
      std::int64_t kept = 0;
      for (std::int64_t e = 0; e < size; ++e)
      {
        out[kept] = { raw[e].offset(c), raw[e].value() };
        kept += raw[e].removed() ? 0 : 1;
      }
      this->Final.close(
        kept, d.rawAlpha[c], d.lastChild[c].row(this->Rows), d.rawStrongest[c].stiff());
    }
  }

  Operators Set;
  CoarseningData Data;
  RowBatch Final;

  /** A sweep over the rows of P: the next row, and up to where all have been relaxed. */
  struct Sweep
  {
    std::int64_t next, settled;
    StepLimit limit;
  };

  StepLimits Limits;
  bool Apart = false; // whether several threads advance the stages

  std::int64_t CoarseBefore = 0;                // coarse nodes a step ago
  const std::int64_t Begin, CoarseBegin;        // the first nodes
  std::int64_t Rows = Begin;                    // of the fine level, that stages may read
  std::int64_t Lifted = Begin, Initial = Begin; // by fine node
  std::vector<Sweep> Relaxed;
  std::int64_t Interpolated = Begin, Seen = Begin, Multiplied = Begin, SeenProducts = Begin;
  std::int64_t ProductEntries = 0;                             // of the rows of A P so far
  std::int64_t Gathered = CoarseBegin, Finished = CoarseBegin; // by coarse node
  std::int64_t Packed = Begin;
  std::int64_t RelaxedDone = Begin, ReachDone = Begin, PatchesDone = Begin, ProductDone = Begin;
};

} // namespace smg
