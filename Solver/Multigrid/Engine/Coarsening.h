// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/InterpolationSweeps.h"
#include "Solver/Multigrid/Engine/LevelCoarsening.h"
#include "Solver/Multigrid/OperatorSet.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace smg
{

/** The stages of a coarsening, compiled for an operator set: loops that call its steps node by
 * node. */
template <OperatorSet Operators>
class Coarsening final : public LevelCoarsening
{
public:
  /** `stiff`: finds the stiff rows of the coarse level; `pipelined`: whether stages may run on
   * several threads. */
  Coarsening(Pool& pool, Operators operators, LevelRows& fine, LevelRows& coarse,
    SliverRows stiff = {}, bool pipelined = false)
    : LevelCoarsening(pool, fine, coarse, stiff, pipelined, patchRingsOf(operators))
    , Set(std::move(operators))
    , Sweeps(this->Set.interpolationSweeps(), this->Begin)
  {
  }

  void advanceChoice() override
  {
    this->choose();
    this->interpolateInitial();
  }

  void advanceInterpolation() override
  {
    this->Data.slots.extend(this->Data.publishedCoarse);
    this->interpolate();
  }

  void advanceProducts() override
  {
    this->Data.productSlots.extend(this->Data.interpolatedCoarse);
    this->productAP();
  }

  void advanceGathering() override { this->productPtAP(); }

  void advanceCoarseRows() override
  {
    this->sparsify(this->Data.arrived);
    this->finish();
  }

private:
  void limitSweeps(std::int64_t rows) override { this->Sweeps.begin(rows); }

  void choose()
  {
    CoarseningData& d = this->Data;
    d.coarseIndex.extend(this->Rows);
    this->Limits.choose.run(
      this->Chosen, this->Rows,
      [&](std::int64_t) { return !(this->Pipelined && d.patches.isFull()); },
      [&](std::int64_t i)
      {
        // First, since the choice needs the diagonal of the row.
        d.patches.add(d.fine);
        if (d.overlaps)
        {
          d.overlapping.add();
        }
        const bool isCoarse = this->Set.isCoarse(d, i);
        d.coarseIndex[i] =
          isCoarse ? CoarseningData::coarseIndexOf(d.coarseNodes) : CoarseningData::FPoint;
        if (isCoarse)
        {
          d.finePoint.append(i);
          ++d.coarseNodes;
          if (d.fine.isPlaced())
          {
            d.coarsePoint.extendRaw(d.coarseNodes);
            std::copy_n(d.fine.point(i), 3, d.coarsePoint.at(d.coarseNodes - 1));
          }
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
      [&](std::int64_t i)
      {
        return d.fine.reach(i) < this->Chosen &&
               (!this->Pipelined || d.initial.hasRoom(d.maxInitial(i)));
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
      [&](std::int64_t)
      {
        return !(
          this->Pipelined && (d.patchMatrices.isFull() || (d.overlaps && d.overlapping.isFull())));
      },
      [&](std::int64_t i)
      {
        d.rowQuanta.extendRaw(i + 1);
        this->Set.interpolate(d, i);
        const CoarseningData::PatchEntries entries = d.appendPatchMatrix(i);
        this->PatchEntries.add(entries.own);
        this->OverlappingEntries.add(entries.overlapping);
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
               (!this->Pipelined || d.product.hasRoom(d.maxProducts(i)));
      },
      [&](std::int64_t i)
      {
        d.productSum.extendRaw(i + 1);
        this->Set.productAP(d, i);
        d.patchReach.append(d.lastAround(i));
        this->ProductEntries.add(d.product.size(i));
      });
  }

  /** Products in the order of coarse nodes. On one thread each row is sparsified at once;
   * pipelined, the rows of a step wait for the next one. */
  void productPtAP()
  {
    CoarseningData& d = this->Data;
    this->Limits.productPtAP.run(
      this->Gathered, d.interpolatedCoarse, [&](std::int64_t c) { return this->canGather(c); },
      [&](std::int64_t c)
      {
        this->Set.productPtAP(d, c);
        if (!this->Pipelined)
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
        d.mayEnd(this->Sparsified);
        d.appendRaw(this->Sparsified, row, entries);
        this->Set.sparsify(d, this->Sparsified++);
      });
  }

  Operators Set;
  InterpolationSweeps<Operators> Sweeps;
};

} // namespace smg
