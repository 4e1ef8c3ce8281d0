// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/CoarseningData.h"
#include "Solver/Hierarchy/RowBatch.h"
#include "Solver/Operators/OperatorSet.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace smg
{

/**
 * Builds a level from the next finer one, as far as the rows of that exist. Every stage has a
 * cursor, the next node to process; it may process a node when the stages it depends on have passed
 * the largest index that the node needs. Data that no stage needs any more are released.
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
    , Relaxed(static_cast<std::size_t>(this->Set.interpolationSweeps()))
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
    this->see();
    this->advanceProducts();
    this->release();
  }

  // The same on two threads: between begin() and release(), advanceInterpolation() and
  // advanceProducts() may run at the same time, the latter on the interpolation of earlier steps.

  /** The nodes by which the stages advance at once. */
  static constexpr std::int64_t StepNodes = 4 * RowBlock::Nodes;

  void beginApart()
  {
    this->begin(this->Lifted + StepNodes);
    this->see();
    this->reserve();
    this->Apart = true;
  }
  /** The rows that no stage has processed. */
  std::int64_t waiting() const { return this->Data.fine.end() - this->Lifted; }

  /** The stages that determine P. */
  void advanceInterpolation()
  {
    this->lift();
    this->interpolate();
  }

  /** The stages from P to the coarse rows. */
  void advanceProducts()
  {
    this->Data.productSlots.extend(this->Data.knownCoarse);
    this->multiply();
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
  void see()
  {
    this->Seen = this->Interpolated;
    this->Data.knownCoarse = this->Data.coarseNodes;
  }

  /** Makes room for what this step adds to the data that both threads use. */
  void reserve()
  {
    CoarseningData& d = this->Data;
    const std::int64_t rows = this->Rows - this->Interpolated, lifts = this->Rows - this->Lifted;
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
  }

  void lift()
  {
    CoarseningData& d = this->Data;
    d.lifted.extend(this->Rows);
    for (std::int64_t& i = this->Lifted; i < this->Rows && !(this->Apart && d.patches.isFull());
         ++i)
    {
      d.patches.add(d.fine);
      const bool lifted = this->Set.lift(d, i);
      d.lifted[i] = lifted ? static_cast<CoarseIndex>(d.coarseNodes) : CoarseningData::Retained;
      if (lifted)
      {
        d.liftedFrom.append(i);
        ++d.coarseNodes;
      }
    }
    d.firstChild.extend(d.coarseNodes);
    d.lastChild.extend(d.coarseNodes);
    d.slots.extend(d.coarseNodes);
  }

  void interpolate()
  {
    CoarseningData& d = this->Data;
    const std::int64_t rows = this->Lifted;
    for (std::int64_t& i = this->Initial; i < rows && d.fine.reach(i) < this->Lifted; ++i)
    {
      this->Set.interpolateInitial(d, i);
    }
    this->relax();
    d.rowQuanta.extendRaw(rows);
    for (std::int64_t& i = this->Interpolated; i < this->Relaxed.back().settled; ++i)
    {
      this->Set.interpolate(d, i);
      d.settledReach.append(settled(d, i));
    }
  }

  static std::int64_t settled(const CoarseningData& data, std::int64_t i)
  {
    std::int64_t last = data.patches.last(i);
    for (const RowEntry& entry : data.fine.row(i))
    {
      last = std::max(last, data.patches.last(i + entry.delta()));
    }
    return last;
  }

  /** The sweeps over the rows of P, one after the other. */
  void relax()
  {
    CoarseningData& d = this->Data;
    std::int64_t before = this->Initial;
    for (Sweep& sweep : this->Relaxed)
    {
      while (sweep.next < this->Lifted && d.fine.reach(sweep.next) < before)
      {
        if (sweep.next == d.relaxed.end())
        {
          d.relaxed.extendRaw(sweep.next + 1);
          d.relaxed[sweep.next].size = RelaxedRow::Pending;
        }
        this->Set.relaxInterpolation(d, sweep.next++);
      }
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
    const std::int64_t rows = this->Rows;
    d.productSum.extendRaw(rows);
    for (std::int64_t& i = this->Multiplied; i < rows && d.fine.reach(i) < this->Seen; ++i)
    {
      this->Set.multiply(d, i);
    }
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
    return d.lastChild[c].row(d.liftedFrom[c]) < this->Multiplied;
  }

  void gather()
  {
    CoarseningData& d = this->Data;
    for (std::int64_t& c = this->Gathered; c < d.knownCoarse && this->canGather(c); ++c)
    {
      d.openRaw(c + 1);
      this->Set.gather(d, c);
      this->Set.sparsify(d, c);
    }
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
    std::int64_t next = 0, settled = 0;
  };

  bool Apart = false;                   // whether two threads advance the stages
  std::int64_t Rows = 0;                // of the fine level, that stages may read
  std::int64_t Lifted = 0, Initial = 0; // by fine node
  std::vector<Sweep> Relaxed;
  std::int64_t Interpolated = 0, Seen = 0, Multiplied = 0;
  std::int64_t Gathered = 0, Finished = 0; // by coarse node
  std::int64_t Packed = 0;
  std::int64_t RelaxedDone = 0, ReachDone = 0, PatchesDone = 0, ProductDone = 0;
};

} // namespace smg
