// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/LevelRows.h"
#include "Solver/Storage/Ring.h"

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

/** An entry of row `fine` of the interpolation P, and the next one of the same column. */
struct InterpolationEntry
{
  CoarseIndex coarse;
  std::uint32_t fine; ///< low 32 bits
  std::uint32_t next; ///< how many entries ahead; 0: none
  std::uint32_t quanta;

  float weight() const { return static_cast<float>(this->quanta) * Quantum; }
};

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
    , parentReach(pool)
    , product(pool)
    , productSum(pool)
    , liftedFrom(pool)
    , firstChild(pool)
    , lastChild(pool)
    , raw(pool)
    , rawAlpha(pool)
    , rawStrongest(pool)
    , childReach(pool)
    , rawReach(pool)
    , rawLower(pool)
    , rawFilled(pool)
    , slots(pool)
  {
  }

  LevelRows& fine;
  LevelRows& coarse;

  // By fine node.
  Ring<std::int64_t> lifted; ///< its coarse node, or -1 if it is retained
  RaggedRing<InitialEntry> initial;
  RaggedRing<InterpolationEntry> interpolation;
  Ring<std::int32_t> rowQuanta;   ///< sum of the row of P
  Ring<std::int64_t> parentReach; ///< largest coarse index in rows 0 .. i of P, or -1
  RaggedRing<ProductEntry> product;
  Ring<double> productSum; ///< sum of the row of A P

  // By coarse node.
  Ring<std::int64_t> liftedFrom;            ///< its fine node
  Ring<std::int64_t> firstChild, lastChild; ///< places in `interpolation` of its column, or -1
  RaggedRing<RowEntry> raw;                 ///< rows of P^T A P, before and during sparsification
  Ring<double> rawAlpha;
  Ring<float> rawStrongest;
  Ring<std::int64_t> childReach; ///< the last of its children
  Ring<std::int64_t> rawReach;   ///< largest column of the row, at least the row itself
  Ring<std::int32_t> rawLower;   ///< columns below the row
  Ring<std::int32_t> rawFilled;  ///< columns above the row that have been mirrored

  /** Scratch of the stages: a mark and a value for each coarse node. */
  struct Slot
  {
    std::uint32_t mark;
    union
    {
      float value;
      std::uint32_t place;
    };
  };
  Ring<Slot> slots;
  /** A mark that no slot bears. */
  std::uint32_t freshMark()
  {
    this->Mark += this->Mark == UINT32_MAX ? 2 : 1;
    return this->Mark;
  }

  std::int64_t coarseNodes = 0;

private:
  std::uint32_t Mark = 0;
};

} // namespace smg
