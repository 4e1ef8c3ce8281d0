// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/RaggedRing.h"
#include "Solver/Memory/Ring.h"
#include "Solver/Multigrid/Setup/LevelRows.h"
#include "smg/Export.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** A symmetric matrix on the nodes of a patch, of order up to Largest: its lower triangle by rows.
 */
template <int Largest>
struct PatchMatrixUpTo
{
  static constexpr int Most = Largest;
  static constexpr int Entries = Most * (Most + 1) / 2;

  int order = 0;
  double entry[Entries] = {};

  static constexpr int entriesOf(int order) { return order * (order + 1) / 2; }
  static constexpr int place(int a, int b)
  {
    return std::max(a, b) * (std::max(a, b) + 1) / 2 + std::min(a, b);
  }

  double& at(int a, int b) { return this->entry[place(a, b)]; }
  double at(int a, int b) const { return this->entry[place(a, b)]; }

  /** The submatrix of the nodes `members`. */
  PatchMatrixUpTo part(const int* members, int count) const
  {
    PatchMatrixUpTo part;
    part.order = count;
    for (int a = 0; a < count; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        part.at(a, b) = this->at(members[a], members[b]);
      }
    }
    return part;
  }

  /**
   * Replaces the matrix by a generalised inverse, by its factors L D L^T. There are no roots, so
   * that the matrix times a power of two gives the same bits.
   *
   * If a pivot is at most `least` times its diagonal entry, the row and column of that node become
   * zero: up to rounding, the other nodes determine its correction, as in a patch that is a
   * component of its own, and it is not corrected. Returns whether there is no such pivot.
   */
  bool invert(double least)
  {
    bool definite = true;
    double lower[Most][Most] = {}; // inverse of L
    double inverse[Most];          // inverse of D
    for (int a = 0; a < this->order; ++a)
    {
      double row[Most]; // row a of L
      double pivot = this->at(a, a);
      for (int b = 0; b < a; ++b)
      {
        double sum = 0.0;
        for (int k = 0; k <= b; ++k)
        {
          sum += lower[b][k] * this->at(a, k);
        }
        row[b] = sum * inverse[b];
        pivot -= sum * row[b];
      }
      if (!(pivot > least * this->at(a, a)))
      {
        definite = false;
        inverse[a] = 0.0;
        continue;
      }
      inverse[a] = 1.0 / pivot;
      for (int b = 0; b < a; ++b)
      {
        for (int k = b; k < a; ++k)
        {
          lower[a][b] -= row[k] * lower[k][b];
        }
      }
      lower[a][a] = 1.0;
    }
    for (int a = 0; a < this->order; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        double sum = 0.0;
        for (int k = a; k < this->order; ++k)
        {
          sum += lower[k][a] * inverse[k] * lower[k][b];
        }
        this->at(a, b) = sum;
      }
    }
    return definite;
  }
};

/** Nodes of a level, at most Largest. */
template <int Largest>
struct PatchUpTo
{
  static constexpr int Most = Largest;

  std::int64_t first;
  std::int32_t size;
  std::int32_t offset[Most]; ///< distance of each member from the first one, ascending
  std::uint32_t link;        ///< of what keeps the patch, to what it keeps beside it

  std::int64_t member(int k) const { return this->first + this->offset[k]; }
  std::int64_t last() const { return this->member(this->size - 1); }
  /** Makes `nodes`, ascending, the members. */
  void setMembers(std::span<const std::int64_t> nodes)
  {
    this->first = nodes.front();
    this->size = static_cast<std::int32_t>(nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k)
    {
      this->offset[k] = static_cast<std::int32_t>(nodes[k] - this->first);
    }
  }
};

/** A patch: a few nodes of a level that are coupled so strongly that they must be relaxed
 * together. The stiffness of a sliver is nearly of rank one, so that one of its vertices alone
 * can hardly move. A tetrahedral sliver that was refined once is a cluster of ten vertices, of
 * which patches of 8 would leave some out. */
using Patch = PatchUpTo<12>;
using PatchMatrix = PatchMatrixUpTo<Patch::Most>;

/** The matrix of the level on the members of a patch, whose rows must exist. */
template <int Most>
PatchMatrixUpTo<Most> matrixOf(const LevelRows& rows, const PatchUpTo<Most>& patch)
{
  PatchMatrixUpTo<Most> matrix;
  matrix.order = patch.size;
  for (int a = 0; a < patch.size; ++a)
  {
    const std::int64_t i = patch.member(a);
    matrix.at(a, a) = rows.diagonal(i);
    const auto row = rows.row(i);
    // Where a row has weights in double precision these count: the matrix of a sliver is nearly
    // singular, and floats would lose its smallest eigenvalues.
    const std::span<const double> precise = rows.precise(i);
    std::size_t e = 0;
    for (int b = 0; b < a; ++b)
    {
      const auto delta = static_cast<std::int32_t>(patch.member(b) - i);
      // Members and columns both ascend: one walk along the row finds all of them.
      while (e < row.size() && row[e].delta() < delta)
      {
        ++e;
      }
      if (e < row.size() && row[e].delta() == delta)
      {
        matrix.at(a, b) = precise.empty() ? -static_cast<double>(row[e].weight()) : -precise[e];
      }
    }
  }
  return matrix;
}

/** The largest node that a patch which begins at `first` may contain: within one ring, or two. */
SMG_EXPORT std::int64_t lastOf(const LevelRows& rows, std::int64_t first, int rings);

/** The matrices of complete patches, by ascending first nodes, kept until the blocks with their
 * members have been packed. */
class PatchMatrices
{
public:
  explicit PatchMatrices(Pool& pool)
    : Triangles(pool)
    , First(pool)
  {
  }

  /** Appends the matrix of a patch, whose rows must exist, and returns the number of its
   * entries. */
  std::int64_t append(const LevelRows& rows, Patch& patch)
  {
    const std::int64_t size = PatchMatrix::entriesOf(patch.size);
    const std::int64_t number = this->Triangles.end();
    std::copy_n(matrixOf(rows, patch).entry, size, this->Triangles.open(size));
    this->Triangles.close(size);
    this->First.extendRaw(number + 1);
    this->First[number] = patch.first;
    patch.link = static_cast<std::uint32_t>(number);
    return size;
  }

  /** The lower triangle, by rows, of the matrix of a patch. */
  const double* of(const Patch& patch) const
  {
    const std::int64_t first = this->Triangles.first();
    return this->Triangles.row(first + (patch.link - static_cast<std::uint32_t>(first)));
  }

  /** Provides room for this number of matrices with this number of entries in all. Until they
   * are appended, or isFull(), nothing moves, so that other threads may read earlier matrices. */
  void reserve(std::int64_t matrices, std::int64_t entries)
  {
    this->Triangles.reserve(matrices, entries);
    this->First.reserveMore(matrices);
  }
  bool isFull() { return !this->Triangles.hasRoom(PatchMatrix::Entries); }

  /** Releases the matrices of patches whose first node is below `node`. */
  void release(std::int64_t node)
  {
    std::int64_t number = this->First.first();
    while (number < this->First.end() && this->First[number] < node)
    {
      ++number;
    }
    this->First.release(number);
    this->Triangles.release(number);
  }

private:
  RaggedRing<double> Triangles;
  Ring<std::int64_t> First; ///< the first nodes
};

/**
 * Finds the patches of a level as its rows arrive. With node j come its couplings |a_ij| /
 * sqrt(a_ii a_jj) to lower neighbours i. Where one is above StrongAlone, or above Strong if the
 * weights of row i or j cancel, the patches of i and j become one, the strongest coupling first,
 * provided that the result has room and lies within a ring or two of its first node.
 *
 * What moves together must be in one patch: a cluster of ten vertices of which two lie in another
 * patch converges as slowly as without patches. The limit by rings bounds how far a sweep has to
 * run ahead before the patch of a node is known and complete, and with it the window.
 */
class SMG_EXPORT Patches
{
public:
  /** With 0.4 or more, patches of marching tetrahedra lack a vertex; below 0.3, patches of
   * refined tetrahedra fill up with others. Windows grow as it falls. */
  static constexpr double Strong = 0.35;
  /** Without slivers, patches by weaker couplings than this save no V-cycle and need up to an
   * eighth more memory. */
  static constexpr double StrongAlone = 0.5;

  explicit Patches(Pool& pool)
    : Number(pool)
    , ByNumber(pool)
    , Diagonals(pool)
  {
  }

  /** Adds the next node; its row and all before it exist. */
  void add(const LevelRows& rows);

  /** Provides room for this number of further nodes and for some patches. Other threads may read
   * earlier nodes and patches while nodes are added, until isFull(). */
  void reserve(std::int64_t nodes)
  {
    this->Number.reserve(this->Number.end() - this->Number.first() + nodes);
    this->Diagonals.reserve(this->Diagonals.end() - this->Diagonals.first() + nodes);
    this->Room = this->ByNumber.end() + std::max(MinMorePatches, nodes / 4);
    this->ByNumber.reserve(
      this->Room + 1 - this->ByNumber.first()); // one more, since a number may be skipped
  }
  bool isFull() const { return this->Room >= 0 && this->ByNumber.end() >= this->Room; }

  /** Sets the number of rings, 1 or 2, within which patches lie around their first node.
   * Clusters in solids need 2; on surfaces the second ring costs up to an eighth more memory
   * and saves few V-cycles. To be called before the first node. */
  void setRings(int rings) { this->Rings = rings; }
  int rings() const { return this->Rings; }

  /** The patch of node i, or null. It is complete once all nodes within the rings of its first
   * node have been added. */
  const Patch* of(std::int64_t i) const
  {
    const std::uint32_t number = this->Number[i];
    return number == Alone ? nullptr : &this->patch(number);
  }
  /** The patch whose first member is node i, complete, or null. */
  Patch* beginningAt(std::int64_t i)
  {
    const std::uint32_t number = this->Number[i];
    Patch* patch = number == Alone ? nullptr : &this->patch(number);
    return patch && patch->first == i ? patch : nullptr;
  }
  /** The last member of the patch of node i, or i without a patch. */
  std::int64_t last(std::int64_t i) const
  {
    const Patch* patch = this->of(i);
    return patch ? patch->last() : i;
  }
  /** The last member of the patches of node i and its neighbours. */
  std::int64_t lastAround(const LevelRows& rows, std::int64_t i) const
  {
    std::int64_t last = this->last(i);
    for (const RowEntry& entry : rows.row(i))
    {
      last = std::max(last, this->last(i + entry.delta()));
    }
    return last;
  }
  /** The diagonal of row i. */
  float diagonal(std::int64_t i) const { return this->Diagonals[i]; }

  /** Releases the nodes below `node` and the patches that end below it; if `node` is beyond the
   * end, it is the next node. */
  void release(std::int64_t node);

private:
  static constexpr std::uint32_t Alone = 0;

  /** The square of the coupling of the next node j with a lower one, times the diagonal of j. */
  struct Coupling
  {
    double square;
    std::int64_t node;
  };
  static constexpr std::int64_t MinMorePatches = 256;

  /** The patch with these low 32 bits of its number; there are fewer than 2^32 patches in
   * memory. */
  Patch& patch(std::uint32_t number) const
  {
    const std::int64_t first = this->ByNumber.first();
    return this->ByNumber[first + (number - static_cast<std::uint32_t>(first))];
  }
  void join(const LevelRows& rows, std::int64_t j, std::int64_t i);

  Ring<std::uint32_t> Number; // by node: low 32 bits of the number of its patch, or Alone
  Ring<Patch> ByNumber;       // by number; no number has the low 32 bits Alone
  Ring<float> Diagonals;      // by node
  int Rings = 1;
  std::int64_t Room = -1; // end of the patches for which there is room; -1: without reserve()
};

} // namespace smg
