// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/LevelRows.h"
#include "Solver/Storage/MonotoneRing.h"
#include "Solver/Storage/RaggedRing.h"

#include <bit>
#include <cstdint>

namespace smg
{

/**
 * A coarse index by its low 32 bits. All that are alive at once lie within 2^31 of each other, so
 * the rest follows from any of them.
 */
using CoarseIndex = std::uint32_t;

/** Distance of a coarse index from `near`, whose full index is known. */
inline std::int32_t offset(CoarseIndex index, std::int64_t near)
{
  return static_cast<std::int32_t>(index - static_cast<CoarseIndex>(near));
}

/** An entry of a row of the initial interpolation. */
struct InitialEntry
{
  CoarseIndex coarse;
  float weight;
};

/** Interpolation weights are multiples of 1/Quanta, so that row sums are exact. */
inline constexpr int Quanta = 255;
inline constexpr float Quantum = 1.0F / Quanta;

/**
 * A child of a coarse node: the row of the interpolation, by its low 29 bits, and the entry in it.
 * Rows that are alive at once lie within 2^28 of each other.
 */
class ChildLink
{
public:
  /** Most entries of a row that have links. */
  static constexpr int Slots = 7;

  /** No child. */
  ChildLink() = default;
  ChildLink(std::int64_t row, int slot)
    : Bits(static_cast<std::uint32_t>(row) << 3 | static_cast<std::uint32_t>(slot))
  {
  }

  bool none() const { return this->Bits == ~std::uint32_t(0); }
  int slot() const { return static_cast<int>(this->Bits & 7); }
  /** The row, given any row that is alive. */
  std::int64_t row(std::int64_t near) const
  {
    const std::uint32_t distance =
      (this->Bits & ~std::uint32_t(7)) - (static_cast<std::uint32_t>(near) << 3);
    return near + (static_cast<std::int32_t>(distance) >> 3);
  }

private:
  std::uint32_t Bits = ~std::uint32_t(0);
};

/**
 * An entry of a row of the interpolation P, and the next child of its coarse node. The coarse node
 * is known by its low 24 bits: those that are alive at once are fewer than CoarseWindow.
 */
class InterpolationEntry
{
public:
  static constexpr std::int64_t CoarseWindow = std::int64_t(1) << 23;

  InterpolationEntry(CoarseIndex coarse, std::uint32_t quanta)
    : Bits(coarse << 8 | quanta)
  {
  }

  std::uint32_t quanta() const { return this->Bits & 255; }
  float weight() const { return static_cast<float>(this->quanta()) * Quantum; }
  /** Distance of the coarse node from `near`, which is alive. */
  std::int32_t offset(std::int64_t near) const
  {
    const std::uint32_t distance =
      (this->Bits & ~std::uint32_t(255)) - (static_cast<std::uint32_t>(near) << 8);
    return static_cast<std::int32_t>(distance) >> 8;
  }

  ChildLink next;

private:
  std::uint32_t Bits;
};
static_assert(sizeof(InterpolationEntry) == 8 && Quanta <= 255);

/** An entry of a row of the product A P. */
struct ProductEntry
{
  CoarseIndex coarse;
  float value;
};

/**
 * Everything that the step from a level (fine) to the next one (coarse) keeps in memory, as
 * windows. The stages that fill it are those of the operator set; Coarsening drives them.
 */
struct CoarseningData
{
  CoarseningData(Pool& pool, LevelRows& fineRows, LevelRows& coarseRows)
    : fine(fineRows)
    , coarse(coarseRows)
    , lifted(pool)
    , initial(pool)
    , interpolation(pool)
    , rowQuanta(pool)
    , parentReach(pool, -1)
    , product(pool)
    , productSum(pool)
    , liftedFrom(pool, -1)
    , firstChild(pool)
    , lastChild(pool)
    , raw(pool)
    , rawAlpha(pool)
    , rawStrongest(pool)
    , rawLower(pool)
    , rawMirrored(pool)
    , rawSettled(pool)
    , slots(pool)
    , largeWeight(pool)
  {
  }

  LevelRows& fine;
  LevelRows& coarse;

  // By fine node.
  /** Its coarse node by the low 32 bits, or Retained. */
  Ring<CoarseIndex> lifted;
  static constexpr CoarseIndex Retained = ~CoarseIndex(0);
  RaggedRing<InitialEntry> initial;
  RaggedRing<InterpolationEntry> interpolation;
  Ring<std::uint16_t> rowQuanta; ///< sum of the row of P
  MonotoneRing parentReach;      ///< largest coarse index in rows 0 .. i of P, or -1
  RaggedRing<ProductEntry> product;
  Ring<double> productSum; ///< sum of the row of A P

  // By coarse node.
  MonotoneRing liftedFrom;               ///< its fine node
  Ring<ChildLink> firstChild, lastChild; ///< of its column of P
  RaggedRing<RowEntry> raw;              ///< rows of P^T A P, before and during sparsification
  Ring<double> rawAlpha;
  Ring<float> rawStrongest;
  Ring<std::int32_t> rawLower; ///< columns below the row
  /** Where the entry is that the last row so far which has one for this row mirrors. */
  Ring<std::int32_t> rawMirrored;
  /** Columns below the row that have their final weight: until then only the upper one counts. */
  Ring<std::int32_t> rawSettled;

  /** Scratch of the stages: a mark and a value for each coarse node. */
  struct Slot
  {
    std::uint32_t mark;
    float value;

    /**
     * Adds to the value, which begins with 0 for a mark that the slot does not bear yet; answers
     * whether it did. Without branches: nothing could predict them.
     */
    bool add(std::uint32_t fresh, float more)
    {
      const bool known = this->mark == fresh;
      const std::uint32_t bits = std::bit_cast<std::uint32_t>(this->value);
      this->mark = fresh;
      this->value = std::bit_cast<float>(bits & (0U - std::uint32_t(known))) + more;
      return !known;
    }
  };
  Ring<Slot> slots;
  /** Scratch of sparsification: 0 for each coarse node but while a row is treated. */
  Ring<float> largeWeight;
  /** A mark that no slot bears. */
  std::uint32_t freshMark()
  {
    this->Mark += this->Mark == UINT32_MAX ? 2 : 1;
    return this->Mark;
  }

  /** The entry of P that a link stands for, given any row that is alive. */
  InterpolationEntry& child(ChildLink link, std::int64_t near) const
  {
    return this->interpolation.row(link.row(near))[link.slot()];
  }

  std::int64_t coarseNodes = 0;

private:
  std::uint32_t Mark = 0;
};

} // namespace smg
