// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/RaggedRing.h"
#include "Solver/Memory/Ring.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace smg
{

/** An off-diagonal entry of row i of the matrix of a level: A_ij = -weight, j = i + delta.
 * Packed in seven bytes, since these are most of what a level keeps in memory while the
 * hierarchy is built. */
class RowEntry
{
public:
  /** The largest distance of two nodes that share an edge. */
  static constexpr std::int64_t MaxDistance = (std::int64_t(1) << 23) - 1;

  RowEntry() = default;
  RowEntry(std::int32_t delta, float weight)
  {
    const std::int32_t shifted = delta * 256;
    std::memcpy(this->Bytes.data() + 3, &shifted, sizeof(shifted));
    this->setWeight(weight);
  }

  /** From -MaxDistance to MaxDistance. */
  std::int32_t delta() const
  {
    std::int32_t shifted = 0;
    std::memcpy(&shifted, this->Bytes.data() + 3, sizeof(shifted));
    return shifted >> 8;
  }
  float weight() const
  {
    float weight = 0.0F;
    std::memcpy(&weight, this->Bytes.data(), sizeof(weight));
    return weight;
  }
  void setWeight(float weight) { std::memcpy(this->Bytes.data(), &weight, sizeof(weight)); }

private:
  std::array<std::byte, 7> Bytes; // the weight and 24 bits of delta
};
static_assert(sizeof(RowEntry) == 7 && std::endian::native == std::endian::little);

/** The largest weight of a row, 0 if there is none, and whether the row is stiff (see
 * SliverRows), in four bytes: each row in a window has one. */
class StrongestWeight
{
public:
  StrongestWeight() = default;
  /** `weight`: at least 0. */
  StrongestWeight(float weight, bool stiff)
    : Signed(stiff ? -weight : weight)
  {
  }

  float weight() const { return std::fabs(this->Signed); }
  bool stiff() const { return std::signbit(this->Signed); }

private:
  float Signed; // the weight, negated if the row is stiff
};

/** The diagonal to divide by, given the row sum plus the weights. */
inline double nonZeroDiagonal(double sum)
{
  // A sum of 0 belongs to the only node of a component without constraint. Any correction of it is
  // right, and this diagonal makes it zero. So it does where weights of both signs cancel, which is
  // no diagonal to divide by either: LevelRows::frozen() counts these rows.
  constexpr double Isolated = 1e20;
  return sum > 0.0 ? sum : Isolated;
}

/** The diagonal of a row whose sum is rowSum. `precise`: its weights in double precision, if it
 * has any. */
inline double diagonalOf(
  std::span<const RowEntry> row, double rowSum, std::span<const double> precise = {})
{
  double sum = rowSum;
  if (!precise.empty())
  {
    for (const double weight : precise)
    {
      sum += weight;
    }
    return nonZeroDiagonal(sum);
  }
  for (const RowEntry& entry : row)
  {
    sum += entry.weight();
  }
  return nonZeroDiagonal(sum);
}

/** What describes a row besides its entries; see LevelRows::close(). */
struct ClosedRow
{
  std::int64_t size;
  double rowSum;
  std::int64_t childReach;
  bool stiff;
  std::size_t precise; ///< number of weights in double precision
};

/** The rows of the matrix of a level while the level is built, in node order, with entries by
 * ascending column. The diagonal is not stored: A_ii = rowSum + sum of the weights, so the row
 * sum is exactly rowSum. */
class LevelRows
{
public:
  explicit LevelRows(Pool& pool)
    : Entries(pool)
    , Precise(pool)
    , RowSum(pool)
    , Strongest(pool)
    , Points(pool, 3)
    , Reach(pool, 0)
    , ChildReach(pool, -1)
  {
  }

  /** The first row in memory. */
  std::int64_t first() const { return this->Entries.first(); }
  /** The end of the rows so far, all of which are final. */
  std::int64_t end() const { return this->Entries.end(); }
  /** Whether all rows of the level have been appended. */
  bool Ended = false;

  std::span<const RowEntry> row(std::int64_t i) const
  {
    return { this->Entries.row(i), static_cast<std::size_t>(this->Entries.size(i)) };
  }
  /** The weights of row i in double precision, or none. */
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
    return diagonalOf(this->row(i), this->rowSum(i), this->precise(i));
  }
  /** The sum of the magnitudes of the weights of row i. */
  float magnitudes(std::int64_t i) const
  {
    float sum = 0.0F;
    for (const RowEntry& entry : this->row(i))
    {
      sum += std::fabs(entry.weight());
    }
    return sum;
  }
  double rowSum(std::int64_t i) const { return this->RowSum[i]; }
  /** The largest weight of row i, 0 if there is none. */
  float strongest(std::int64_t i) const { return this->Strongest[i].weight(); }
  /** Whether row i is stiff. */
  bool stiff(std::int64_t i) const { return this->Strongest[i].stiff(); }
  /** Whether the nodes have positions. */
  bool isPlaced() const { return this->Placed; }
  /** The position of node i, three numbers: of a coarse node, that of its C-point. */
  const float* point(std::int64_t i) const { return this->Points.at(i); }
  /** The largest node index that occurs in rows 0 .. i, at least i: what a stage must have
   * passed before the next one may process row i. */
  std::int64_t reach(std::int64_t i) const { return this->Reach[i]; }
  /** The last node of the finer level that interpolates from one of the nodes 0 .. i; -1 on
   * level 0. */
  std::int64_t childReach(std::int64_t i) const { return this->ChildReach[i]; }
  /** The number of entries of all rows so far, with the diagonals. */
  std::int64_t nonzeros() const { return this->Nonzeros; }
  /** The number of rows so far whose node gets no correction though it has neighbours: weights of
   * both signs cancel, so that there is no positive diagonal to divide by. See nonZeroDiagonal().
   */
  std::int64_t frozen() const { return this->Frozen; }

  /** Returns room for at most `size` entries of the next row. */
  RowEntry* open(std::int64_t size) { return this->Entries.open(size); }

  /** Ends the row begun by open(). `childReach` is the last child of this node alone; `stiff`:
   * see SliverRows; `precise`: its weights in double precision, or none. */
  void close(std::int64_t size, double rowSum, std::int64_t childReach, bool stiff = false,
    std::span<const double> precise = {})
  {
    const ClosedRow row{ size, rowSum, childReach, stiff, precise.size() };
    this->close({ &row, 1 }, this->Entries.opened(), precise.data());
  }

  /** Appends rows with these entries, and with precise weights where they have any. Returns the
   * end of the entries. */
  const RowEntry* append(
    std::span<const ClosedRow> rows, const RowEntry* entries, const double* precise)
  {
    std::int64_t size = 0;
    for (const ClosedRow& row : rows)
    {
      size += row.size;
    }
    RowEntry* out = this->open(size);
    std::copy_n(entries, size, out);
    this->close(rows, out, precise);
    return entries + size;
  }

  /** Places the last `count` nodes; returns room for their positions. Of a level without positions
   * it is never called, of others for each node. */
  float* place(std::int64_t count)
  {
    const std::int64_t begin = this->end() - count;
    if (!this->Placed)
    {
      this->Placed = true;
      this->Points.restart(begin);
    }
    this->Points.extendRaw(begin + count);
    return this->Points.at(begin);
  }

  /** The largest i (at most end()) such that no row from `done` on contains a node below i: a
   * stage that has passed `done` needs no data of these nodes any more. It is at least `from`. */
  std::int64_t unreached(std::int64_t from, std::int64_t done) const
  {
    std::int64_t i = from;
    while (i < this->end() && this->Reach[i] < done)
    {
      ++i;
    }
    return i;
  }

  /** Releases rows below `row`, and reach() below `reach`, which stages need for longer. If both
   * are beyond the end, `row` is the next row. */
  void release(std::int64_t row, std::int64_t reach)
  {
    this->Entries.release(row);
    this->Precise.release(row);
    this->RowSum.release(row);
    this->Strongest.release(row);
    this->ChildReach.release(row);
    this->Reach.release(std::min(row, reach));
  }
  /** Releases the positions of nodes below `node`. */
  void releasePoints(std::int64_t node)
  {
    if (this->Placed)
    {
      this->Points.release(node);
    }
  }

private:
  /** Ends rows whose entries are in the room that open() returned. */
  void close(std::span<const ClosedRow> rows, const RowEntry* entry, const double* precise)
  {
    const std::int64_t begin = this->end();
    const std::int64_t end = begin + static_cast<std::int64_t>(rows.size());
    this->RowSum.extendRaw(end);
    this->Strongest.extendRaw(end);
    this->Reach.reserve(end - begin);
    this->ChildReach.reserve(end - begin);
    double* rowSum = this->RowSum.at(begin);
    StrongestWeight* strongest = this->Strongest.at(begin);
    std::int64_t i = begin;
    for (const ClosedRow& row : rows)
    {
      float largest = 0.0F;
      double sum = row.rowSum;
      for (std::int64_t e = 0; e < row.size; ++e)
      {
        largest = std::max(largest, entry[e].weight());
        sum += entry[e].weight();
      }
      this->Frozen += row.size > 0 && row.precise == 0 && sum <= 0.0 ? 1 : 0;
      const std::int64_t last = row.size > 0 ? i + std::max(0, entry[row.size - 1].delta()) : i;
      this->Entries.close(row.size);
      *rowSum++ = row.rowSum;
      *strongest++ = { largest, row.stiff };
      this->Reach.append(last);
      this->ChildReach.append(row.childReach);
      this->keep({ precise, row.precise });
      this->Nonzeros += row.size + 1;
      entry += row.size;
      precise += row.precise;
      ++i;
    }
  }

  /** Stores the precise weights of the last row. Rows without any are appended, empty, only when
   * a later row has some: most levels have none and take no memory for them. */
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
    }
    std::ranges::copy(precise, this->Precise.open(static_cast<std::int64_t>(precise.size())));
    this->Precise.close(static_cast<std::int64_t>(precise.size()));
  }

  RaggedRing<RowEntry> Entries;
  RaggedRing<double> Precise;
  Ring<double> RowSum;
  Ring<StrongestWeight> Strongest;
  Ring<float> Points; // 3 per node, or none
  MonotoneRing Reach, ChildReach;
  std::int64_t Nonzeros = 0, Frozen = 0;
  bool Placed = false;
};

/** The entries of consecutive rows, in memory that stays allocated when they are cleared. */
template <class Entry>
class RowEntries
{
public:
  /** Room for at most `size` entries of the next row. */
  Entry* open(std::int64_t size)
  {
    // It only grows, since resize() clears what it adds.
    const std::size_t end = this->Used + static_cast<std::size_t>(size);
    this->Entries.resize(std::max(this->Entries.size(), end));
    return this->Entries.data() + this->Used;
  }
  /** Ends the row begun by open(). */
  void close(std::int64_t size) { this->Used += static_cast<std::size_t>(size); }

  std::int64_t bytes() const
  {
    return static_cast<std::int64_t>(this->Entries.capacity() * sizeof(Entry));
  }
  const Entry* data() const { return this->Entries.data(); }
  void clear() { this->Used = 0; }

private:
  std::vector<Entry> Entries;
  std::size_t Used = 0;
};

} // namespace smg
