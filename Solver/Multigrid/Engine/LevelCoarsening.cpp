// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/LevelCoarsening.h"

#include "smg/Error.h"

#include <algorithm>
#include <cassert>
#include <utility>

// What does not depend on the operators: how far stages may go, what waits for whom, and when
// memory is reserved and released.

namespace smg
{

LevelCoarsening::LevelCoarsening(
  Pool& pool, LevelRows& fine, LevelRows& coarse, SliverRows stiff, bool pipelined, int patchRings)
  : Data(pool, fine, coarse, stiff, pipelined)
  , Begin(fine.first())
  , CoarseBegin(coarse.first())
  , Final(pool)
{
  this->Data.patches.setRings(patchRings);
}

void LevelCoarsening::advance(std::int64_t rows)
{
  this->begin(rows);
  this->advanceChoice();
  this->publishInitial();
  this->advanceInterpolation();
  this->publishInterpolation();
  this->advanceProducts();
  this->Multiplied.publish();
  this->advanceGathering();
  this->advanceCoarseRows();
  this->release();
}

std::int64_t LevelCoarsening::beginPipelined(std::int64_t nodes)
{
  assert(&this->Data.productSlots != &this->Data.slots); // made for several threads
  const std::int64_t coarse = this->usualCoarseRows(nodes);
  this->Limits.begin(nodes, coarse);
  this->limitSweeps(StepLimits::more(nodes));
  this->begin(this->Chosen + this->Limits.choose.nodes());
  std::swap(this->Data.gathered, this->Data.arrived);
  this->Multiplied.publish();
  this->publishInterpolation();
  this->publishInitial();
  this->reserve();
  this->Pipelined = true;
  return coarse;
}
void LevelCoarsening::handOver()
{
  CoarseningData& d = this->Data;
  const std::int64_t begin = d.coarse.end();
  this->Final.moveTo(d.coarse);
  if (d.fine.isPlaced() && begin < d.coarse.end())
  {
    std::ranges::copy(
      d.coarsePoint.range(begin, d.coarse.end()), d.coarse.place(d.coarse.end() - begin));
    d.coarsePoint.release(d.coarse.end());
  }
  d.coarse.Ended = d.fine.Ended && this->Chosen == d.fine.end() && this->Finished == d.coarseNodes;
}

void LevelCoarsening::release()
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
  d.fine.releasePoints(this->Interpolated);
  const std::int64_t patchesDone = std::min<std::int64_t>(this->PatchesDone, this->Multiplied);
  d.patches.release(patchesDone);
  if (d.overlaps)
  {
    d.overlapping.release(patchesDone);
  }
  d.patchMatrices.release(this->MatricesDone);
  while (this->ProductDone < this->Multiplied && d.parentReach[this->ProductDone] < this->Gathered)
  {
    ++this->ProductDone;
  }
  d.product.release(this->ProductDone);
  d.productSum.release(this->ProductDone);
  const std::int64_t interpolationDone =
    std::min({ this->ReachDone, this->ProductDone, this->Packed });
  d.interpolation.release(interpolationDone);
  d.rowQuanta.release(interpolationDone);
  d.patchReach.release(this->Packed);
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

/** Lets the stages read the existing rows below `rows`. Refuses a stream order for which a
 * window would have more coarse nodes than entries can distinguish. */
void LevelCoarsening::begin(std::int64_t rows)
{
  this->Rows = std::min(rows, this->Data.fine.end());
  if (this->Chosen == this->Begin && this->Rows > this->Begin)
  {
    // childReach() is -1 on the finest level only.
    this->Data.overlaps =
      this->Data.patches.rings() > 1 && this->Data.fine.childReach(this->Begin) < 0;
  }
  if (this->Data.coarseNodes - this->Finished >= CoarseWindow)
  {
    throw Error("neighbours lie too far apart in the stream: convert the mesh with the order bfs");
  }
}

/** Publishes the coarse nodes and P0 so far to the stages of advanceInterpolation(). */
void LevelCoarsening::publishInitial()
{
  this->Initial.publish();
  this->Data.publishedCoarse = this->Data.coarseNodes;
}

/** Publishes P so far to the stages from productAP() on. */
void LevelCoarsening::publishInterpolation()
{
  this->Interpolated.publish();
  this->Data.interpolatedCoarse = this->Data.publishedCoarse;
  this->Data.gatherSlots.extend(this->Data.interpolatedCoarse);
  this->Data.sparsifySlots.extend(this->Data.interpolatedCoarse);
}

/** The number of coarse rows that this number of rows becomes, on average so far or as in the
 * last step. */
std::int64_t LevelCoarsening::usualCoarseRows(std::int64_t rows)
{
  const std::int64_t chosen = this->Chosen - this->Begin;
  const std::int64_t coarse = this->Data.coarseNodes - this->CoarseBegin;
  const std::int64_t last = coarse - std::exchange(this->CoarseBefore, coarse);
  return std::min(rows, std::max(last, chosen > 0 ? rows * coarse / chosen : rows));
}

/** Reserves room for what this step adds to the data that several threads use. Rings grow only
 * here. */
void LevelCoarsening::reserve()
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
  if (d.overlaps)
  {
    using Matrix = OverlappingPatches::Matrix;
    const std::int64_t entries = this->OverlappingEntries.of(rows) + Matrix::Entries;
    d.overlapping.reserve(choices);
    // They have at least two nodes, and most of them more than a dozen.
    d.overlapping.reserve(1 + entries / Patch::Most, entries);
  }
  d.parentReach.reserve(rows);
  d.finePoint.reserve(choices);
  if (d.fine.isPlaced())
  {
    d.coarsePoint.reserveMore(choices);
  }
  d.firstChild.reserve(d.coarseNodes + choices - d.firstChild.first());
  d.lastChild.reserve(d.coarseNodes + choices - d.lastChild.first());
  this->reserveInitial();
  this->reserveProducts();
}

/** The same for P0: room for rows of the mean length, and for the longest that the next one
 * may be, so that the stage always advances. */
void LevelCoarsening::reserveInitial()
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
void LevelCoarsening::reserveProducts()
{
  CoarseningData& d = this->Data;
  const std::int64_t rows = std::min(this->Rows - this->Multiplied, this->Limits.productAP.nodes());
  if (rows > 0)
  {
    d.product.reserve(rows, this->ProductEntries.of(rows) + d.maxProducts(this->Multiplied));
    d.productSum.reserve(this->Multiplied + rows - d.productSum.first());
    d.patchReach.reserve(rows);
  }
}

bool LevelCoarsening::canGather(std::int64_t c) const
{
  const CoarseningData& d = this->Data;
  const std::int64_t ring = d.fine.reach(d.finePoint[c]);
  if (ring >= this->Rows || d.fine.reach(ring) >= this->Interpolated.published())
  {
    return false;
  }
  return d.lastChild[c].row(d.finePoint[c]) < this->Multiplied.published();
}

void LevelCoarsening::finish()
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

} // namespace smg
