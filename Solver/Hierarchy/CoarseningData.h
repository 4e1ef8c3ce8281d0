// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/CoarseEntry.h"
#include "Solver/Hierarchy/LevelRows.h"
#include "Solver/Hierarchy/Patches.h"
#include "Solver/Hierarchy/StiffRows.h"
#include "Solver/Hierarchy/StrongestWeight.h"
#include "Solver/Storage/MonotoneRing.h"
#include "Solver/Storage/RaggedRing.h"

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
  CoarseningData(Pool& pool, LevelRows& fineRows, LevelRows& coarseRows, StiffRows stiffRows = {})
    : fine(fineRows)
    , coarse(coarseRows)
    , stiff(stiffRows)
    , lifted(pool)
    , patches(pool)
    , initial(pool)
    , initialSum(pool)
    , relaxed(pool)
    , interpolation(pool)
    , rowQuanta(pool)
    , parentReach(pool, coarseRows.first() - 1)
    , settledReach(pool, fineRows.first() - 1)
    , product(pool)
    , productSum(pool)
    , liftedFrom(pool, fineRows.first() - 1)
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
    , productSlots(pool)
    , gatherSlots(pool)
    , knownCoarse(coarseRows.first())
    , coarseNodes(coarseRows.first())
  {
    this->begin(fineRows.first(), coarseRows.first());
  }

  LevelRows& fine;
  LevelRows& coarse;
  StiffRows stiff; ///< of the coarse level

  // By fine node.
  /** Its coarse node as by liftedTo(), or Retained. */
  Ring<CoarseIndex> lifted;
  static constexpr CoarseIndex Retained = ~CoarseIndex(0);
  /** The low 31 bits, which are never Retained: entries store fewer. */
  static CoarseIndex liftedTo(std::int64_t coarse)
  {
    return static_cast<CoarseIndex>(coarse & INT32_MAX);
  }
  Patches patches;
  RaggedRing<CoarseEntry> initial;
  Ring<float> initialSum; ///< of the row of `initial`
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
  MonotoneRing liftedFrom;               ///< its fine node
  Ring<ChildLink> firstChild, lastChild; ///< of its column of P
  /** Off-diagonal rows of -P^T A P, before and during sparsification. */
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

  /** Scratch of the stages for coarse nodes, which may run on three threads: those up to
   * interpolate(), multiply(), and those from gather() on. */
  SlotRing slots, productSlots, gatherSlots;
  /** The end of the coarse nodes that the stages from multiply() on know. */
  std::int64_t knownCoarse = 0;

  /** Room in addition to the rows of `raw` below `end`. */
  void openRaw(std::int64_t end)
  {
    this->rawAlpha.extendRaw(end);
    this->rawStrongest.extendRaw(end);
    this->rawDiagonal.extendRaw(end);
    this->rawKept.extend(end);
    for (auto* ring : { &this->rawLower, &this->rawMirrored, &this->rawSettled })
    {
      ring->extend(end);
    }
    this->rawLarge.extendRaw(end);
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

  std::int64_t coarseNodes = 0; ///< the next coarse node

private:
  /** Sets the next fine and coarse nodes. */
  void begin(std::int64_t i, std::int64_t c)
  {
    this->lifted.release(i);
    this->patches.release(i);
    this->initial.release(i);
    this->initialSum.release(i);
    this->relaxed.release(i);
    this->interpolation.release(i);
    this->rowQuanta.release(i);
    this->parentReach.release(i);
    this->settledReach.release(i);
    this->product.release(i);
    this->productSum.release(i);
    this->liftedFrom.release(c);
    this->firstChild.release(c);
    this->lastChild.release(c);
    this->releaseRaw(c);
    this->slots.release(c);
    this->productSlots.release(c);
    this->gatherSlots.release(c);
  }
};

} // namespace smg
