// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/RowEntry.h"
#include "Solver/Hierarchy/StrongestWeight.h"
#include "Solver/Storage/MonotoneRing.h"
#include "Solver/Storage/RaggedRing.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace smg
{

/** The diagonal for divisions, given the sum of alpha and the weights. */
inline double usableDiagonal(double sum)
{
  // The only node of a component without constraint: any correction is correct, and this diagonal
  // makes it zero.
  constexpr double Isolated = 1e20;
  return sum > 0.0 ? sum : Isolated;
}

/** The diagonal of a row whose sum is alpha; `precise`: its weights in double precision, if any. */
inline double diagonalOf(
  std::span<const RowEntry> row, double alpha, std::span<const double> precise = {})
{
  double sum = alpha;
  if (!precise.empty())
  {
    for (const double weight : precise)
    {
      sum += weight;
    }
    return usableDiagonal(sum);
  }
  for (const RowEntry& entry : row)
  {
    sum += entry.weight();
  }
  return usableDiagonal(sum);
}

/** The rows of a level's matrix while the level is built, in node order: entries by ascending
 * column, A_ii = diagonal = alpha + sum of the weights, so alpha is the row sum. */
class LevelRows
{
public:
  explicit LevelRows(Pool& pool)
    : Entries(pool)
    , Precise(pool)
    , Alpha(pool)
    , Strongest(pool)
    , Reach(pool, 0)
    , ChildReach(pool, -1)
  {
  }

  /** Rows appended so far; all of them are final. */
  std::int64_t end() const { return this->Entries.end(); }
  /** Whether no row follows. */
  bool Ended = false;

  std::span<const RowEntry> row(std::int64_t i) const
  {
    return { this->Entries.row(i), static_cast<std::size_t>(this->Entries.size(i)) };
  }
  /** The weights of row i in double precision, if they were given. */
  std::span<const double> precise(std::int64_t i) const
  {
    if (i >= this->Precise.end())
    {
      return {};
    }
    return { this->Precise.row(i), static_cast<std::size_t>(this->Precise.size(i)) };
  }
  double diagonal(std::int64_t i) const
  {
    return diagonalOf(this->row(i), this->alpha(i), this->precise(i));
  }
  double alpha(std::int64_t i) const { return this->Alpha[i]; }
  /** The largest weight of row i, 0 if there is none. */
  float strongest(std::int64_t i) const { return this->Strongest[i].weight(); }
  /** Whether row i is stiff. */
  bool stiff(std::int64_t i) const { return this->Strongest[i].stiff(); }
  /** The largest node index that occurs in rows 0 .. i, at least i. */
  std::int64_t reach(std::int64_t i) const { return this->Reach[i]; }
  /** The last node of the finer level that interpolates from a node 0 .. i; -1 on level 0. */
  std::int64_t childReach(std::int64_t i) const { return this->ChildReach[i]; }
  /** Entries of all rows so far, diagonals included. */
  std::int64_t nonzeros() const { return this->Nonzeros; }

  /** Returns room for at most `size` entries of the next row. */
  RowEntry* open(std::int64_t size) { return this->Entries.open(size); }

  /** Ends the row begun by open(). `childReach` is that of this node alone; `stiff`: see StiffRows;
   * `precise`: its weights in double precision, or none. */
  void close(std::int64_t size, double alpha, std::int64_t childReach, bool stiff = false,
    std::span<const double> precise = {})
  {
    const std::int64_t i = this->end();
    const RowEntry* entry = this->Entries.opened();
    float strongest = 0.0F;
    for (std::int64_t e = 0; e < size; ++e)
    {
      strongest = std::max(strongest, entry[e].weight());
    }
    const std::int64_t last = size > 0 ? i + std::max(0, entry[size - 1].delta()) : i;
    this->Entries.close(size);
    this->Alpha.extendRaw(i + 1);
    this->Strongest.extendRaw(i + 1);
    this->Alpha[i] = alpha;
    this->Strongest[i] = { strongest, stiff };
    this->Reach.append(last);
    this->ChildReach.append(childReach);
    this->keep(precise);
    this->Nonzeros += size + 1;
  }

  /** The largest i (at most end()) such that the nodes below i occur in rows below `done` only. */
  std::int64_t unreached(std::int64_t from, std::int64_t done) const
  {
    std::int64_t i = from;
    while (i < this->end() && this->Reach[i] < done)
    {
      ++i;
    }
    return i;
  }

  /** Releases rows below `row`, and reach() below `reach`. */
  void release(std::int64_t row, std::int64_t reach)
  {
    this->Entries.release(row);
    this->Released = row;
    this->Precise.release(std::min(row, this->Precise.end()));
    this->Alpha.release(row);
    this->Strongest.release(row);
    this->ChildReach.release(row);
    this->Reach.release(std::min(row, reach));
  }

private:
  /** Stores the precise weights of the last row; rows after the last one with any take no room. */
  void keep(std::span<const double> precise)
  {
    if (precise.empty())
    {
      return;
    }
    while (this->Precise.end() + 1 < this->end())
    {
      this->Precise.open(0);
      this->Precise.close(0);
      this->Precise.release(std::min(this->Released, this->Precise.end()));
    }
    std::ranges::copy(precise, this->Precise.open(static_cast<std::int64_t>(precise.size())));
    this->Precise.close(static_cast<std::int64_t>(precise.size()));
  }

  RaggedRing<RowEntry> Entries;
  RaggedRing<double> Precise;
  Ring<double> Alpha;
  Ring<StrongestWeight> Strongest;
  MonotoneRing Reach, ChildReach;
  std::int64_t Nonzeros = 0, Released = 0;
};

} // namespace smg
