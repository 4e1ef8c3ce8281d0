// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/RaggedRing.h"
#include "Solver/Memory/Ring.h"
#include "Solver/Multigrid/Setup/GatheredRows.h"
#include "Solver/Multigrid/Setup/LevelRows.h"
#include "Solver/Multigrid/Setup/Patches.h"
#include "Solver/Multigrid/Setup/SliverRows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace smg
{

/** A row of the interpolation while it is relaxed, with the sum of its weights, which is stored
 * separately: it is exactly 1 where no constraint reaches. */
struct RelaxedRow
{
  static constexpr int Most = 5;
  static constexpr std::int8_t Pending = -1;

  float sum;
  CoarseEntry entry[Most];
  std::int8_t size; ///< Pending: still the initial interpolation, like rows to come
};
static_assert(sizeof(RelaxedRow) == 40);

/** Interpolation weights are multiples of 1/Quanta in [-1, 1], so that row sums are exact. */
inline constexpr int Quanta = 127;
inline constexpr float Quantum = 1.0F / Quanta;

/**
 * A child of a coarse node: the row of the interpolation, by its low 29 bits, and the entry in it.
 * Rows that are alive at once lie within 2^28 of each other.
 */
class ChildLink
{
public:
  /** The maximum number of entries of a row with links. */
  static constexpr int Slots = 7;

  /** No child. */
  ChildLink() = default;
  ChildLink(std::int64_t row, int slot)
    : Bits(static_cast<std::uint32_t>(row) << 3 | static_cast<std::uint32_t>(slot))
  {
  }

  bool none() const { return this->Bits == ~std::uint32_t(0); }
  int slot() const { return static_cast<int>(this->Bits & 7); }
  /** The distance of the row from any row that is alive. */
  std::int32_t distance(std::int64_t near) const
  {
    const std::uint32_t distance =
      (this->Bits & ~std::uint32_t(7)) - (static_cast<std::uint32_t>(near) << 3);
    return static_cast<std::int32_t>(distance) >> 3;
  }
  /** The row, given any row that is alive. */
  std::int64_t row(std::int64_t near) const { return near + this->distance(near); }

private:
  std::uint32_t Bits = ~std::uint32_t(0);
};

/** An entry of a row of the interpolation P, and the next child of its coarse node. */
class InterpolationEntry
{
public:
  InterpolationEntry(CoarseIndex coarse, int quanta)
    : Bits(coarse << 8 | static_cast<std::uint8_t>(quanta))
  {
  }

  int quanta() const { return static_cast<std::int8_t>(this->Bits & 255); }
  float weight() const { return static_cast<float>(this->quanta()) * Quantum; }
  /** Distance of the coarse node from `near`, which is alive. */
  std::int32_t offset(std::int64_t near) const { return coarseDistance(this->Bits, near); }

  ChildLink next;

private:
  std::uint32_t Bits;
};
static_assert(sizeof(InterpolationEntry) == 8 && Quanta <= 127);

/** A mark and a value for each coarse node. */
struct Slot
{
  std::uint32_t mark;
  float value;

  // Both without branches, which would be unpredictable.

  /** The value, or 0 if the slot does not have the mark. */
  float get(std::uint32_t fresh) const
  {
    const auto known = static_cast<std::uint32_t>(this->mark == fresh);
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(this->value) & (0U - known));
  }
  /** Adds to the value, which starts at 0 if the slot does not have the mark yet; returns whether
   * it had. */
  bool add(std::uint32_t fresh, float more)
  {
    const bool known = this->mark == fresh;
    this->value = this->get(fresh) + more;
    this->mark = fresh;
    return !known;
  }
};

/** Slots of the coarse nodes that are alive. */
class SlotRing : public Ring<Slot>
{
public:
  using Ring<Slot>::Ring;

  /** A mark that no slot has. */
  std::uint32_t freshMark()
  {
    this->Mark += this->Mark == UINT32_MAX ? 2 : 1;
    return this->Mark;
  }

private:
  std::uint32_t Mark = 0;
};

/** The data of the step from a level (fine) to the next one (coarse) in memory, as windows that
 * begin with the first rows of these. They are filled by the stages of the operator set, which
 * Coarsening calls. */
struct CoarseningData
{
  /** `apart`: whether the stages run on several threads. */
  CoarseningData(Pool& pool, LevelRows& fineRows, LevelRows& coarseRows, SliverRows stiffRows = {},
    bool apart = false)
    : fine(fineRows)
    , coarse(coarseRows)
    , stiff(stiffRows)
    , coarseIndex(pool)
    , patches(pool)
    , patchMatrices(pool)
    , initial(pool)
    , initialTotal(pool)
    , relaxed(pool)
    , interpolation(pool)
    , rowQuanta(pool)
    , parentReach(pool, coarseRows.first() - 1)
    , settledReach(pool, fineRows.first() - 1)
    , product(pool)
    , productSum(pool)
    , finePoint(pool, fineRows.first() - 1)
    , firstChild(pool)
    , lastChild(pool)
    , raw(pool)
    , rawAlpha(pool)
    , rawStrongest(pool)
    , rawDiagonal(pool)
    , rawKept(pool)
    , rawLower(pool)
    , rawMirrored(pool)
    , rawSettled(pool)
    , rawLarge(pool)
    , slots(pool)
    , ownSlots{ SlotRing(pool), SlotRing(pool), SlotRing(pool) }
    , productSlots(apart ? ownSlots[0] : slots)
    , gatherSlots(apart ? ownSlots[1] : slots)
    , sparsifySlots(apart ? ownSlots[2] : slots)
    , seenCoarse(coarseRows.first())
    , knownCoarse(coarseRows.first())
    , coarseNodes(coarseRows.first())
  {
    this->begin(fineRows.first(), coarseRows.first());
  }
  CoarseningData(const CoarseningData&) = delete;
  CoarseningData& operator=(const CoarseningData&) = delete;

  LevelRows& fine;
  LevelRows& coarse;
  SliverRows stiff; ///< of the coarse level

  // By fine node.
  /** Its coarse node as by coarseIndexOf(), or FPoint. */
  Ring<CoarseIndex> coarseIndex;
  static constexpr CoarseIndex FPoint = ~CoarseIndex(0);
  /** The low 31 bits, which are never FPoint: entries store fewer. */
  static CoarseIndex coarseIndexOf(std::int64_t coarse)
  {
    return static_cast<CoarseIndex>(coarse & INT32_MAX);
  }
  Patches patches;
  PatchMatrices patchMatrices; ///< by patch
  RaggedRing<CoarseEntry> initial;
  Ring<float> initialTotal; ///< Z of the row of `initial`: its weights were divided by it
  Ring<RelaxedRow> relaxed;
  RaggedRing<InterpolationEntry> interpolation;
  Ring<std::int16_t> rowQuanta; ///< sum of the row of P
  MonotoneRing parentReach;     ///< largest coarse index in rows 0 .. i of P, or -1
  /** The last node of the patches of the nodes in rows 0 .. i, after which all of these are
   * relaxed. */
  MonotoneRing settledReach;
  RaggedRing<CoarseEntry> product; ///< rows of A P
  Ring<float> productSum;          ///< sum of the row of A P

  // By coarse node.
  MonotoneRing finePoint;                ///< its fine node
  Ring<ChildLink> firstChild, lastChild; ///< of its column of P
  /** Rows of -P^T A P that sparsify() has not got: those of this step, and of the step before. */
  GatheredRows gathered, arrived;
  /** Off-diagonal rows of -P^T A P during sparsification. */
  RaggedRing<CoarseEntry> raw;
  Ring<double> rawAlpha;
  Ring<StrongestWeight> rawStrongest;
  Ring<float> rawDiagonal;
  /** Whether no entry of the row may be removed. */
  Ring<std::uint8_t> rawKept;
  Ring<std::int32_t> rawLower; ///< columns below the row
  /** The position of the entry that mirrors that of the last row with an entry for this row. */
  Ring<std::int32_t> rawMirrored;
  /** Columns below the row with their final weight; until then only the upper one is valid. */
  Ring<std::int32_t> rawSettled;
  /** Scratch of sparsification: which of the first 64 entries were large when the row came. */
  Ring<std::uint64_t> rawLarge;

  /** Scratch of the stages for coarse nodes: `slots` of relaxInterpolation() and interpolate(),
   * and, unless they run apart, of productAP(), productPtAP() and sparsify(), too. */
  SlotRing slots;
  std::array<SlotRing, 3> ownSlots; ///< empty unless the stages run apart
  SlotRing &productSlots, &gatherSlots, &sparsifySlots;
  /** The ends of the coarse nodes that the stages from relaxInterpolation() on know, and those from
   * productAP() on. */
  std::int64_t seenCoarse = 0, knownCoarse = 0;

  /** Upper bounds of the entries of row i of the initial P, and of A P. */
  std::int64_t maxInitial(std::int64_t i) const
  {
    return static_cast<std::int64_t>(this->fine.row(i).size()) + 1;
  }
  std::int64_t maxProducts(std::int64_t i) const
  {
    return RelaxedRow::Most * (static_cast<std::int64_t>(this->fine.row(i).size()) + 1);
  }

  /** The sum of row i of the initial P. */
  float initialSum(std::int64_t i) const
  {
    const auto rowSum = static_cast<float>(std::max(0.0, this->fine.rowSum(i)));
    const float total = this->initialTotal[i];
    return this->coarseIndex[i] != FPoint ? 1.0F : total > rowSum ? (total - rowSum) / total : 0.0F;
  }

  /** Appends the matrix of the patch that begins at node i, if one does, whose rows exist; returns
   * its entries. */
  std::int64_t appendPatchMatrix(std::int64_t i)
  {
    Patch* patch = this->patches.beginningAt(i);
    return patch ? this->patchMatrices.append(this->fine, *patch) : 0;
  }

  /** Appends row c to `raw`, the next one. */
  void appendRaw(std::int64_t c, const GatheredRow& row, const CoarseEntry* entries)
  {
    std::copy_n(entries, row.size, this->raw.open(row.size));
    this->raw.close(row.size);
    append(this->rawAlpha, c, row.rowSum);
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
    this->rawAlpha.release(first);
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

  /** Sets the next fine and coarse nodes. */
  void begin(std::int64_t i, std::int64_t c)
  {
    this->coarseIndex.release(i);
    this->patches.release(i);
    this->initial.release(i);
    this->initialTotal.release(i);
    this->relaxed.release(i);
    this->interpolation.release(i);
    this->rowQuanta.release(i);
    this->parentReach.release(i);
    this->settledReach.release(i);
    this->product.release(i);
    this->productSum.release(i);
    this->finePoint.release(c);
    this->firstChild.release(c);
    this->lastChild.release(c);
    this->releaseRaw(c);
    this->releaseSlots(c);
  }
};

} // namespace smg
