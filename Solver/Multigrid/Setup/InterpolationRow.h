// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Setup/CoarseningData.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace smg
{

/** The multiple of 1/Quanta that is nearest to a weight; halves are rounded away from 0. */
inline int quantaOf(float weight)
{
  // std::lround() of a number of a few digits, without a call: the sum is exact.
  const float scaled = weight * Quanta;
  return static_cast<int>(static_cast<double>(scaled) + std::copysign(0.5, scaled));
}

/**
 * Appends a row of the interpolation P to `CoarseningData::interpolation`, in the form that the
 * Galerkin product reads: weights in multiples of 1/Quanta, each entry linked to the column of its
 * coarse node, and the row's sum and reach. At most ChildLink::Slots entries.
 */
class InterpolationRow
{
public:
  /** Opens row i, the next one, with room for `most` entries. */
  InterpolationRow(CoarseningData& data, std::int64_t i, std::int64_t most)
    : Data(data)
    , Row(i)
    , Near(data.publishedCoarse)
    , Out(data.interpolation.open(most))
    , Rows(data.interpolation.near(i))
    , FirstChild(data.firstChild.at(Near))
    , LastChild(data.lastChild.at(Near))
  {
  }

  /** Appends an entry: the distance of a coarse node, which the row does not have yet, from
   * publishedCoarse, and the weight in multiples of 1/Quanta, from -Quanta to Quanta. 0: no entry.
   */
  void append(std::int32_t offset, int quanta)
  {
    if (quanta == 0)
    {
      return; // less than half a quantum, rounded away
    }
    // The entry ends the chain of its column: rows are appended in stream order, so the chain of a
    // coarse node lists its children in this order.
    const ChildLink link(this->Row, this->Size);
    ChildLink& last = this->LastChild[offset];
    (last.none() ? this->FirstChild[offset]
                 : this->Rows[last.distance(this->Row)][last.slot()].next) = link;
    last = link;
    const std::int64_t node = this->Near + offset;
    this->Out[this->Size++] = InterpolationEntry(static_cast<CoarseIndex>(node), quanta);
    this->Reach = std::max(this->Reach, node);
    this->Sum += quanta;
  }

  /** Ends the row. */
  void close()
  {
    this->Data.interpolation.close(this->Size);
    this->Data.rowQuanta[this->Row] = static_cast<std::int16_t>(this->Sum);
    this->Data.parentReach.append(this->Reach);
  }

private:
  CoarseningData& Data;
  std::int64_t Row, Near;
  InterpolationEntry* Out; // opened first: it may move the rows
  RaggedRing<InterpolationEntry>::Near Rows;
  ChildLink *FirstChild, *LastChild;
  int Size = 0, Sum = 0;
  std::int64_t Reach = -1;
};

/** Appends row i, with its weights rounded: the wanted sum is rounded by itself, and the entries
 * are adjusted to it. The sums of rows of P are exact, Quanta where no constraint reaches. */
inline void appendRounded(CoarseningData& data, std::int64_t i, const RelaxedRow& row)
{
  int rounded[RelaxedRow::Most];
  int rest = quantaOf(row.sum);
  for (int k = 0; k < row.size; ++k)
  {
    rounded[k] = quantaOf(std::clamp(row.entry[k].value(), -1.0F, 1.0F));
    rest -= rounded[k];
  }
  InterpolationRow out(data, i, row.size);
  for (int k = 0; k < row.size; ++k)
  {
    // The first entry, the largest, receives the remainder, which changes it least in proportion;
    // only what would take it out of [-1, 1] goes to the next one.
    const int quanta = std::clamp(rounded[k] + rest, -Quanta, Quanta);
    rest -= quanta - rounded[k];
    out.append(row.entry[k].offset(data.publishedCoarse), quanta);
  }
  out.close();
}

} // namespace smg
