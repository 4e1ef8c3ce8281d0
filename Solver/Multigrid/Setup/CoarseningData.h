// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/CancelCheck.h"
#include "Solver/Memory/RaggedRing.h"
#include "Solver/Memory/Ring.h"
#include "Solver/Multigrid/Setup/GatheredRows.h"
#include "Solver/Multigrid/Setup/LevelRows.h"
#include "Solver/Multigrid/Setup/OverlappingPatches.h"
#include "Solver/Multigrid/Setup/Patches.h"
#include "Solver/Multigrid/Setup/SliverRows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace smg
{

/** A row of the interpolation while it is relaxed. The sum of its weights is stored separately:
 * it is exactly 1 where no constraint reaches, which a sum of the rounded weights would not be. */
struct RelaxedRow
{
  static constexpr int Most = 5;
  static constexpr std::int8_t Pending = -1;

  float sum;
  CoarseEntry entry[Most];
  std::int8_t size; ///< Pending: not relaxed, the initial row counts
};
static_assert(sizeof(RelaxedRow) == 40);

/** Interpolation weights are multiples of the quantum 1/Quanta in [-1, 1]: they take a byte, and
 * sums of rows of P are exact integers. */
inline constexpr int Quanta = 127;
inline constexpr float Quantum = 1.0F / Quanta;

/** A link to a child of a coarse node: the row of P, by its low 29 bits, and the slot of the
 * entry in that row. Rows in memory at the same time lie within 2^28 of each other, so any of
 * them determines the other bits. */
class ChildLink
{
public:
  /** The largest number of entries of a row of P. A slot has three bits; the value 7 is not
   * used, so that no link has all bits set, as none() has. */
  static constexpr int Slots = 7;

  /** No child. */
  ChildLink() = default;
  ChildLink(std::int64_t row, int slot)
    : Bits(static_cast<std::uint32_t>(row) << 3 | static_cast<std::uint32_t>(slot))
  {
  }

  bool none() const { return this->Bits == ~std::uint32_t(0); }
  int slot() const { return static_cast<int>(this->Bits & 7); }
  /** The distance of the row from `near`, any row in memory. */
  std::int32_t distance(std::int64_t near) const
  {
    const std::uint32_t distance =
      (this->Bits & ~std::uint32_t(7)) - (static_cast<std::uint32_t>(near) << 3);
    return static_cast<std::int32_t>(distance) >> 3;
  }
  /** The row, given any row in memory. */
  std::int64_t row(std::int64_t near) const { return near + this->distance(near); }

private:
  std::uint32_t Bits = ~std::uint32_t(0);
};

/** An entry of a row of P: 24 bits of the coarse index, the weight in quanta, and a link to the
 * next child of that coarse node. The links make P accessible by columns, which P^T A P needs,
 * without a transposed copy. */
class InterpolationEntry
{
public:
  InterpolationEntry(CoarseIndex coarse, int quanta)
    : Bits(coarse << 8 | static_cast<std::uint8_t>(quanta))
  {
  }

  int quanta() const { return static_cast<std::int8_t>(this->Bits & 255); }
  float weight() const { return static_cast<float>(this->quanta()) * Quantum; }
  /** The distance of the coarse node from `near`, a coarse node in memory. */
  std::int32_t offset(std::int64_t near) const { return coarseDistance(this->Bits, near); }

  ChildLink next;

private:
  std::uint32_t Bits;
};
static_assert(sizeof(InterpolationEntry) == 8 && Quanta <= 127);

/** A cell of a sparse accumulator that is indexed by coarse node: the value counts only if the
 * mark is that of the current row. A fresh mark for each row clears all slots at once. */
struct Slot
{
  std::uint32_t mark;
  float value;

  // Both without branches, since whether a column is new in a row is unpredictable.

  /** The value, or 0 if the slot does not have the mark. */
  float get(std::uint32_t fresh) const
  {
    const auto known = static_cast<std::uint32_t>(this->mark == fresh);
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(this->value) & (0U - known));
  }
  /** Adds to the value, which starts at 0 if the slot does not have the mark yet; returns
   * whether it was new. */
  bool add(std::uint32_t fresh, float more)
  {
    const bool known = this->mark == fresh;
    this->value = this->get(fresh) + more;
    this->mark = fresh;
    return !known;
  }
};

/** The slots of the coarse nodes in memory. */
class SlotRing : public Ring<Slot>
{
public:
  using Ring<Slot>::Ring;

  /** A mark that no slot has; never 0, the mark of slots that were just appended. */
  std::uint32_t freshMark()
  {
    this->Mark += this->Mark == UINT32_MAX ? 2 : 1;
    return this->Mark;
  }

private:
  std::uint32_t Mark = 0;
};

/** The data of the step from one level (fine) to the next coarser one (coarse), as windows of
 * rings: indices are those of the whole level, and memory contains the range that some stage
 * still needs. The stages of the operator set, called by Coarsening, fill them; Coarsening
 * releases them. */
struct CoarseningData
{
  /** `pipelined`: whether the stages run on several threads and need slots of their own. */
  CoarseningData(Pool& memory, LevelRows& fineRows, LevelRows& coarseRows,
    SliverRows stiffRows = {}, bool pipelined = false)
    : pool(memory)
    , fine(fineRows)
    , coarse(coarseRows)
    , stiff(stiffRows)
    , parentReach(pool, coarseRows.first() - 1)
    , patchReach(pool, fineRows.first() - 1)
    , finePoint(pool, fineRows.first() - 1)
    , productSlots(pipelined ? ownSlots[0] : slots)
    , gatherSlots(pipelined ? ownSlots[1] : slots)
    , sparsifySlots(pipelined ? ownSlots[2] : slots)
    , publishedCoarse(coarseRows.first())
    , interpolatedCoarse(coarseRows.first())
    , coarseNodes(coarseRows.first())
  {
    this->begin(fineRows.first(), coarseRows.first());
  }
  CoarseningData(const CoarseningData&) = delete;
  CoarseningData& operator=(const CoarseningData&) = delete;

  Pool& pool;
  LevelRows& fine;
  LevelRows& coarse;
  SliverRows stiff; ///< of the coarse level

  CancelCheck* check = nullptr; ///< null: the work is never ended
  /** To be called at each row of a stage that may take long for it. Throws as CancelCheck. */
  void mayEnd(std::int64_t row) const
  {
    constexpr std::int64_t Rows = 16;
    if (this->check && row % Rows == 0)
    {
      (*this->check)();
    }
  }

  // By fine node.
  /** The coarse node of a C-point, as coarseIndexOf() stores it, or FPoint. */
  Ring<CoarseIndex> coarseIndex{ pool };
  static constexpr CoarseIndex FPoint = ~CoarseIndex(0);
  /** The low 31 bits of a coarse index, which are never FPoint. Entries store 24 bits, so these
   * suffice. */
  static CoarseIndex coarseIndexOf(std::int64_t coarse)
  {
    return static_cast<CoarseIndex>(coarse & INT32_MAX);
  }
  Patches patches{ pool };
  PatchMatrices patchMatrices{ pool };     ///< by patch
  OverlappingPatches overlapping{ pool };  ///< empty unless `overlaps`
  bool overlaps = false;                   ///< whether the level has overlapping patches
  RaggedRing<CoarseEntry> initial{ pool }; ///< rows of P0
  Ring<float> initialTotal{ pool };        ///< Z_i: row i of `initial` has the weights over Z_i
  Ring<RelaxedRow> relaxed{ pool };
  RaggedRing<InterpolationEntry> interpolation{ pool };
  Ring<std::int16_t> rowQuanta{ pool }; ///< sum of row i of P, in quanta
  MonotoneRing parentReach;             ///< largest coarse index in rows 0 .. i of P, or -1
  /** The last node of the patches of all nodes that occur in rows 0 .. i: once a sweep has
   * passed it, it has relaxed all these nodes. */
  MonotoneRing patchReach;
  RaggedRing<CoarseEntry> product{ pool }; ///< rows of A P
  Ring<float> productSum{ pool };          ///< sum of the row of A P

  // By coarse node.
  MonotoneRing finePoint;                                ///< its fine node
  Ring<float> coarsePoint{ pool, 3 };                    ///< its position, if the nodes have any
  Ring<ChildLink> firstChild{ pool }, lastChild{ pool }; ///< of its column of P
  /** Rows of -P^T A P on their way to sparsify(): those made in this step, and those of the step
   * before, which sparsify() takes. */
  GatheredRows gathered, arrived;
  /** The off-diagonal entries of -P^T A P during sparsification. Each pair {c, k} has an entry
   * in both rows; the upper one, in row min(c, k), counts. */
  RaggedRing<CoarseEntry> raw{ pool };
  Ring<double> rawRowSum{ pool }; ///< row sums
  Ring<StrongestWeight> rawStrongest{ pool };
  Ring<float> rawDiagonal{ pool };
  /** Whether no entry of the row may be removed. */
  Ring<std::uint8_t> rawKept{ pool };
  Ring<std::int32_t> rawLower{ pool }; ///< number of entries below the diagonal
  /** The position in this row of the entry for the last row k that came and has an entry for
   * this one, that is, of the mirror of that entry. Rows come in ascending order, so a counter
   * finds the mirror without a search. */
  Ring<std::int32_t> rawMirrored{ pool };
  /** The number of entries below the diagonal that have their final weight; of the others only
   * the mirrored upper entry is valid. */
  Ring<std::int32_t> rawSettled{ pool };
  /** Scratch of sparsification: which of the first 64 entries were large when the row came. */
  Ring<std::uint64_t> rawLarge{ pool };

  /** Accumulators of the stages, by coarse node: `slots` of relaxInterpolation() and
   * interpolate() and, unless the stages are pipelined, also of productAP(), productPtAP() and
   * sparsify(). */
  SlotRing slots{ pool };
  std::array<SlotRing, 3> ownSlots{ SlotRing(pool), SlotRing(pool),
    SlotRing(pool) }; ///< empty unless the stages are pipelined
  SlotRing &productSlots, &gatherSlots, &sparsifySlots;
  /** The ends of the coarse nodes that the stages know: from relaxInterpolation() on, and from
   * productAP() on. Stages store columns as distances from these. */
  std::int64_t publishedCoarse = 0, interpolatedCoarse = 0;

  /** Upper bounds of the number of entries of row i of P0 and of A P. */
  std::int64_t maxInitial(std::int64_t i) const
  {
    return static_cast<std::int64_t>(this->fine.row(i).size()) + 1;
  }
  std::int64_t maxProducts(std::int64_t i) const
  {
    return RelaxedRow::Most * (static_cast<std::int64_t>(this->fine.row(i).size()) + 1);
  }

  /** The sum of row i of P0: less than 1 where the row sum of A is positive. */
  float initialSum(std::int64_t i) const
  {
    const auto rowSum = static_cast<float>(std::max(0.0, this->fine.rowSum(i)));
    const float total = this->initialTotal[i];
    return this->coarseIndex[i] != FPoint ? 1.0F : total > rowSum ? (total - rowSum) / total : 0.0F;
  }

  /** Appends the matrix of the patch that begins at node i, if one does, and the overlapping patch
   * around it; the rows within its rings must exist. Returns the numbers of their entries. */
  struct PatchEntries
  {
    std::int64_t own = 0, overlapping = 0;
  };
  PatchEntries appendPatchMatrix(std::int64_t i)
  {
    Patch* patch = this->patches.beginningAt(i);
    PatchEntries entries;
    if (patch)
    {
      entries.own = this->patchMatrices.append(this->fine, *patch);
      entries.overlapping =
        this->overlaps ? this->overlapping.append(this->fine, *patch, this->patches.rings()) : 0;
    }
    return entries;
  }
  /** The last member of the patches of node i and its neighbours, overlapping ones included. */
  std::int64_t lastAround(std::int64_t i) const
  {
    std::int64_t last = this->patches.lastAround(this->fine, i);
    if (this->overlaps)
    {
      last = std::max(last, this->overlapping.last(i));
      for (const RowEntry& entry : this->fine.row(i))
      {
        last = std::max(last, this->overlapping.last(i + entry.delta()));
      }
    }
    return last;
  }

  /** Appends the next row, c, to `raw`, and advances rawMirrored of the rows below that have an
   * entry for c. */
  void appendRaw(std::int64_t c, const GatheredRow& row, const CoarseEntry* entries)
  {
    std::copy_n(entries, row.size, this->raw.open(row.size));
    this->raw.close(row.size);
    append(this->rawRowSum, c, row.rowSum);
    append(this->rawStrongest, c, row.strongest);
    append(this->rawDiagonal, c, row.diagonal);
    append(this->rawKept, c, static_cast<std::uint8_t>(row.kept));
    append(this->rawLower, c, row.lower);
    append(this->rawMirrored, c, row.lower - 1);
    append(this->rawSettled, c, 0);
    this->rawLarge.extendRaw(c + 1);
    std::int32_t* mirrored = this->rawMirrored.at(c);
    for (std::int32_t e = 0; e < row.lower; ++e)
    {
      ++mirrored[entries[e].offset(c)];
    }
  }
  /** Releases the rows of `raw` below `first`. */
  void releaseRaw(std::int64_t first)
  {
    this->raw.release(first);
    this->rawRowSum.release(first);
    this->rawStrongest.release(first);
    this->rawDiagonal.release(first);
    this->rawKept.release(first);
    for (auto* ring : { &this->rawLower, &this->rawMirrored, &this->rawSettled })
    {
      ring->release(first);
    }
    this->rawLarge.release(first);
  }

  /** Releases the scratch of coarse nodes below `first`. */
  void releaseSlots(std::int64_t first)
  {
    for (SlotRing* ring :
      { &this->slots, &this->productSlots, &this->gatherSlots, &this->sparsifySlots })
    {
      ring->release(first);
    }
  }

  std::int64_t coarseNodes = 0; ///< the next coarse node

private:
  template <class T>
  static void append(Ring<T>& ring, std::int64_t c, T value)
  {
    ring.extendRaw(c + 1);
    ring[c] = value;
  }

  /** Sets the first fine and the first coarse node of all rings. */
  void begin(std::int64_t i, std::int64_t c)
  {
    this->coarseIndex.release(i);
    this->patches.release(i);
    this->overlapping.release(i);
    this->initial.release(i);
    this->initialTotal.release(i);
    this->relaxed.release(i);
    this->interpolation.release(i);
    this->rowQuanta.release(i);
    this->parentReach.release(i);
    this->patchReach.release(i);
    this->product.release(i);
    this->productSum.release(i);
    this->finePoint.release(c);
    this->coarsePoint.release(c);
    this->firstChild.release(c);
    this->lastChild.release(c);
    this->releaseRaw(c);
    this->releaseSlots(c);
  }
};

} // namespace smg
