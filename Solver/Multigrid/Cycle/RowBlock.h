// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Buffer.h"
#include "Solver/Multigrid/Setup/LevelRows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace smg
{

/** The upper half of a float: the range of a float with 8 bits of precision, rounded to nearest. */
class BFloat16
{
public:
  BFloat16() = default;
  /** `value` must not be NaN. */
  explicit BFloat16(float value)
  {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    this->Bits = static_cast<std::uint16_t>((bits + 0x7FFFU + (bits >> 16 & 1U)) >> 16);
  }

  operator float() const
  {
    return std::bit_cast<float>(static_cast<std::uint32_t>(this->Bits) << 16);
  }

private:
  std::uint16_t Bits = 0;
};

/** An index of a wide block in three bytes, enough for distances of rows and of parents. It is
 * read in one load together with the byte before it, and therefore only in place, in a block. */
class WideIndex
{
public:
  WideIndex() = default;
  /** From -2^23 to 2^23 - 1. */
  explicit WideIndex(std::int32_t index) { std::memcpy(this->Bytes.data(), &index, sizeof(*this)); }
  /** A copy would have another byte before it. */
  WideIndex(const WideIndex&) = delete;
  WideIndex& operator=(const WideIndex&) = default;

  operator std::int64_t() const
  {
    std::int32_t shifted = 0;
    std::memcpy(&shifted, reinterpret_cast<const std::byte*>(this) - 1, sizeof(shifted));
    return std::int64_t(shifted) >> 8;
  }

private:
  std::array<std::byte, 3> Bytes;
};
static_assert(sizeof(WideIndex) == 3 && std::endian::native == std::endian::little);

/**
 * The rows and the interpolation of up to `Nodes` consecutive nodes of a level, in the format on
 * disk, which is used in place without decoding. Columns are stored as distances, of 16 bits
 * ("narrow"), or, if a distance or a count of the block does not fit, of 24 bits ("wide", with
 * counts of 32 bits). For each group of `Group` nodes the header has the largest indices that the
 * cursors need.
 *
 * Diagonals are not stored on disk. sumDiagonals() computes them from the row sums, most of which
 * are zero, and the weights, and appends them to the stored data: whatever the rounding of the
 * weights, a row has exactly its row sum.
 */
class RowBlock
{
public:
  static constexpr std::int64_t Nodes = 1024;
  static constexpr std::int64_t Group = 64;
  static constexpr std::int64_t Groups = Nodes / Group;

  struct Header
  {
    std::int64_t first = 0;      ///< index of the first node
    std::int64_t parentBase = 0; ///< coarse index to which parents are relative
    std::int32_t nodes = 0;
    std::int32_t entries = 0; ///< off-diagonals of all rows
    std::int32_t parents = 0; ///< entries of all rows of P
    std::int8_t wide = 0;
    std::int8_t weightBytes = 0;
    std::uint16_t rowSumGroups = 0; ///< bit g: a row of group g has a non-zero sum
    std::int32_t specials = 0;      ///< number of special nodes
    std::int32_t values = 0;        ///< numbers of patches that end in this block
    std::int32_t precise = 0;       ///< weights in double precision
    /**
     * By group, all for rows 0 .. the end of the group, so that they never decrease.
     * neighbourReach: the largest node in these rows. patchReach: the same, or the last member of
     * the patches of these nodes: after a sweep that relaxes patches the nodes are final only then.
     * childReach, parentReach: the largest child and the largest parent of these rows.
     */
    std::array<std::int64_t, Groups> neighbourReach{}, patchReach{}, childReach{}, parentReach{};
    /** Where the entries and the parents of each group begin. */
    std::array<std::int32_t, Groups> entryStart{}, parentStart{};

    /** The node that a stage must have passed for the next one to process the group; `patched`:
     * that stage relaxes patches. */
    std::int64_t reach(std::size_t group, bool patched) const
    {
      return (patched ? this->patchReach : this->neighbourReach)[group];
    }
  };

  /** A node that kernels treat by itself: its row has weights in double precision, or it belongs
   * to a patch, a few strongly coupled nodes that the first sweep of each half of a V-cycle
   * relaxes together when it reaches the last of them. */
  struct Special
  {
    std::int16_t node; ///< index in the block
    /** The number of nodes relaxed at this one: those of its patch at the last member, 0 at the
     * other members, 1 outside patches. */
    std::int16_t size;
    /** At the last member, where the values of the patch begin: the (negative) distances of the
     * other members, then the lower triangle of the inverse of the matrix on the patch. */
    std::int32_t value;
    std::int32_t precise; ///< begin of the weights of the row in double precision; -1: none
    /** Where the values of the overlapping patches begin whose last member it is; -1: it is that of
     * none. First their number; then, for each, its size and its values, as those of a patch. */
    std::int32_t overlapping;

    static constexpr int valuesOf(int size) { return size - 1 + size * (size + 1) / 2; }
  };
  static_assert(sizeof(Special) == 16);

  /**
   * The arrays of a block; Index is std::int16_t (narrow) or WideIndex (wide) and is read in place,
   * never from a copy.
   *
   * Weight is float on the finest level. Coarse levels only precondition: there it is BFloat16,
   * unless the block has special nodes or the problem may have stiff rows, where it is float, the
   * precision of the coarse operator (CoarseEntry). Diagonals are computed from the rounded
   * weights, so row sums stay exact. On the finest level, rows of slivers have additional weights
   * in double precision.
   */
  template <class Index, class Weight>
  struct Arrays
  {
    using Count =
      std::conditional_t<std::is_same_v<Index, WideIndex>, std::uint32_t, std::uint16_t>;
    const Weight* weight;            // per entry
    const Index* delta;              // per entry
    const Index* parent;             // per parent, relative to parentBase
    const Count* entryEnd;           // per node: end of its entries, from the start of the group
    const Count* parentEnd;          // per node: end of its parents, from the start of the group
    const std::int8_t* parentQuanta; // per parent
    const double* rowSum;            // per node of groups with sums: the row sum
    const Special* special;          // by ascending node
    const double* value;             // of patches, see Special::value
    const double* precise;           // weights of special nodes
    const double* diagonal;          // per node

    /** The same with the weights of a special node in double precision; valid for its row only,
     * whose entries begin at `begin`. */
    Arrays<Index, double> ofPreciseRow(const Special& node, std::int64_t begin) const
    {
      return { this->precise + node.precise - begin, this->delta, this->parent, this->entryEnd,
        this->parentEnd, this->parentQuanta, this->rowSum, this->special, this->value,
        this->precise, this->diagonal };
    }
  };

  RowBlock() = default;
  /** Takes the bytes of a block, from packRows() or a file, with room for the diagonals at their
   * end. */
  explicit RowBlock(Buffer buffer)
    : Bytes(std::move(buffer))
  {
  }

  const Header& header() const { return *reinterpret_cast<const Header*>(this->Bytes.data()); }
  std::int64_t first() const { return this->header().first; }
  std::int64_t end() const { return this->header().first + this->header().nodes; }

  template <class Index, class Weight>
  Arrays<Index, Weight> arrays() const
  {
    const Header& h = this->header();
    Arrays<Index, Weight> a{};
    const std::byte* at = this->Bytes.data() + sizeof(Header);
    take(at, a.weight, h.entries);
    take(at, a.delta, h.entries);
    take(at, a.parent, h.parents);
    take(at, a.entryEnd, h.nodes);
    take(at, a.parentEnd, h.nodes);
    take(at, a.parentQuanta, h.parents);
    take(at, a.rowSum, rowSums(h));
    take(at, a.special, h.specials);
    take(at, a.value, h.values);
    take(at, a.precise, h.precise);
    take(at, a.diagonal, h.nodes);
    return a;
  }

  /** The values of the patches that end in this block, see Special::value. */
  const double* values() const
  {
    const double* values = nullptr;
    this->visit<float>([&values](const auto& arrays) { values = arrays.value; });
    return values;
  }

  /** Calls f(arrays, args...) with the arrays of this block, for a level whose unknowns have type
   * Real: the one place where kernels are chosen by the types of a block. */
  template <class Real, class F, class... Args>
  void visit(F&& f, const Args&... args) const
  {
    const bool wide = this->header().wide != 0;
    if constexpr (!std::is_same_v<Real, double>)
    {
      if (this->header().weightBytes == sizeof(BFloat16))
      {
        wide ? f(this->arrays<WideIndex, BFloat16>(), args...)
             : f(this->arrays<std::int16_t, BFloat16>(), args...);
        return;
      }
    }
    wide ? f(this->arrays<WideIndex, float>(), args...)
         : f(this->arrays<std::int16_t, float>(), args...);
  }

  /** The row sum of node k. */
  template <class Index, class Weight>
  static double rowSumOf(const Header& h, const Arrays<Index, Weight>& a, std::int64_t k)
  {
    const auto group = static_cast<unsigned>(k / Group);
    const unsigned before = h.rowSumGroups & ((1U << group) - 1);
    return h.rowSumGroups >> group & 1 ? a.rowSum[std::popcount(before) * Group + k % Group] : 0.0;
  }

  /** The number of row sums stored: one for each node of the groups with a non-zero sum. All
   * groups except the last one are full. */
  static std::int32_t rowSums(const Header& h)
  {
    const std::int32_t room = std::popcount(h.rowSumGroups) * static_cast<std::int32_t>(Group);
    const std::int32_t last = (h.nodes - 1) / static_cast<std::int32_t>(Group);
    const std::int32_t missing = (last + 1) * static_cast<std::int32_t>(Group) - h.nodes;
    return room - (h.rowSumGroups >> last & 1 ? missing : 0);
  }

  /** Bytes of the diagonals of this many nodes. */
  static std::size_t diagonalBytes(std::int64_t nodes)
  {
    return static_cast<std::size_t>(nodes) * sizeof(double);
  }

  /** Bytes on disk of a block with this header. */
  static std::size_t storedBytes(const Header& h)
  {
    const std::size_t index = h.wide ? sizeof(WideIndex) : sizeof(std::int16_t);
    const std::size_t count = h.wide ? sizeof(std::uint32_t) : sizeof(std::uint16_t);
    const auto nodes = static_cast<std::size_t>(h.nodes);
    const auto entries = static_cast<std::size_t>(h.entries);
    const auto parents = static_cast<std::size_t>(h.parents);
    return sizeof(Header) + aligned(entries * static_cast<std::size_t>(h.weightBytes)) +
           aligned(entries * index) + aligned(parents * index) + 2 * aligned(nodes * count) +
           aligned(parents) + static_cast<std::size_t>(h.specials) * sizeof(Special) +
           (static_cast<std::size_t>(rowSums(h)) + static_cast<std::size_t>(h.values) +
             static_cast<std::size_t>(h.precise)) *
             sizeof(double);
  }

  /** Whether these bytes may be a block of the nodes [first, first + nodes) and have the size
   * that its counts require: a check of files before they are used in place. */
  static bool fits(std::span<const std::byte> stored, std::int64_t first, std::int64_t nodes)
  {
    Header h;
    if (stored.size() < sizeof(h))
    {
      return false;
    }
    std::memcpy(&h, stored.data(), sizeof(h));
    const std::array counts{ h.entries, h.parents, h.specials, h.values, h.precise };
    return h.first == first && h.nodes == nodes && std::ranges::min(counts) >= 0 &&
           (h.wide == 0 || h.wide == 1) &&
           (h.weightBytes == sizeof(float) || h.weightBytes == sizeof(BFloat16)) &&
           h.rowSumGroups >> ((nodes - 1) / Group + 1) == 0 && storedBytes(h) == stored.size();
  }

  /** The part of the block stored on disk. */
  std::span<const std::byte> stored() const
  {
    return this->Bytes.bytes().first(storedBytes(this->header()));
  }
  /** Computes the diagonals from the stored data. */
  void sumDiagonals()
  {
    this->visit<float>([this](const auto& arrays) { this->sumDiagonals(arrays); });
  }

  Buffer takeBuffer() { return std::move(this->Bytes); }

private:
  template <class Index, class Weight>
  void sumDiagonals(const Arrays<Index, Weight>& a);

  static std::size_t aligned(std::size_t bytes) { return (bytes + 7) / 8 * 8; }

  template <class T>
  static void take(const std::byte*& at, const T*& array, std::int32_t count)
  {
    array = reinterpret_cast<const T*>(at);
    at += aligned(static_cast<std::size_t>(count) * sizeof(T));
  }

  Buffer Bytes;
};

/** The nodes [begin, end) of a block, by their indices in the block. */
struct BlockRange
{
  std::int64_t begin, end;
};

/** The entries of row k of a block. */
template <class Arrays>
inline BlockRange entriesOf(const RowBlock::Header& h, const Arrays& a, std::int64_t k)
{
  const std::int32_t start = h.entryStart[static_cast<std::size_t>(k / RowBlock::Group)];
  return { start + (k % RowBlock::Group ? a.entryEnd[k - 1] : 0), start + a.entryEnd[k] };
}

/** The parents of row k of a block. */
template <class Arrays>
inline BlockRange parentsOf(const RowBlock::Header& h, const Arrays& a, std::int64_t k)
{
  const std::int32_t start = h.parentStart[static_cast<std::size_t>(k / RowBlock::Group)];
  return { start + (k % RowBlock::Group ? a.parentEnd[k - 1] : 0), start + a.parentEnd[k] };
}

/** The row of a node of a block: weights w_j of its neighbours, which are `delta` nodes away in
 * ascending order, and the diagonal entry. */
template <class Index, class Weight>
class RowView
{
public:
  RowView(const RowBlock::Header& h, const RowBlock::Arrays<Index, Weight>& a, std::int64_t k)
    : diagonal(a.diagonal[k])
    , Arrays(a)
    , Entries(entriesOf(h, a, k))
  {
  }

  std::int64_t size() const { return this->Entries.end - this->Entries.begin; }
  double weight(std::int64_t e) const { return this->Arrays.weight[this->Entries.begin + e]; }
  std::int64_t delta(std::int64_t e) const { return this->Arrays.delta[this->Entries.begin + e]; }

  /** `sum` + sum_j w_j x_j, with x of the node at `x` and `stride` values per node. Two sums for
   * even and odd entries: the additions of one need not wait for those of the other. The order is
   * fixed, and with it the bits. */
  template <class Vectors, class Real>
  [[gnu::always_inline]] typename Vectors::Vector plusProducts(
    typename Vectors::Vector sum, const Real* x, std::int64_t stride) const
  {
    typename Vectors::Vector odd{};
    std::int64_t e = this->Entries.begin;
    for (; e + 1 < this->Entries.end; e += 2)
    {
      sum += this->product<Vectors>(e, x, stride);
      odd += this->product<Vectors>(e + 1, x, stride);
    }
    if (e < this->Entries.end)
    {
      sum += this->product<Vectors>(e, x, stride);
    }
    return sum + odd;
  }
  /** The same in one sum, of the neighbours that are less than `end` nodes away. */
  template <class Vectors, class Real>
  [[gnu::always_inline]] typename Vectors::Vector plusProductsBelow(
    std::int64_t end, typename Vectors::Vector sum, const Real* x, std::int64_t stride) const
  {
    for (std::int64_t e = this->Entries.begin; e < this->Entries.end && this->Arrays.delta[e] < end;
         ++e)
    {
      sum += this->product<Vectors>(e, x, stride);
    }
    return sum;
  }

  const double diagonal;

private:
  template <class Vectors, class Real>
  [[gnu::always_inline]] typename Vectors::Vector product(
    std::int64_t e, const Real* x, std::int64_t stride) const
  {
    return static_cast<Real>(this->Arrays.weight[e]) *
           Vectors::load(x + this->Arrays.delta[e] * stride);
  }

  const RowBlock::Arrays<Index, Weight>& Arrays;
  BlockRange Entries;
};

/** The nodes of a range that lie in one block, with their unknowns x and right-hand sides b: those
 * of the columns from `lane` on, of node 0 of the block. */
template <class Real>
struct BlockPart
{
  const RowBlock& block;
  BlockRange nodes;
  std::int64_t stride; ///< values per node
  std::int64_t lane;
  Real *x, *b;

  const RowBlock::Header& header() const { return this->block.header(); }
};

/** The special node with index `node` in the block, or else the next one after it. */
template <class Arrays>
const RowBlock::Special* specialFrom(const RowBlock::Header& h, const Arrays& a, std::int64_t node)
{
  return std::lower_bound(a.special, a.special + h.specials, node,
    [](const RowBlock::Special& s, std::int64_t n) { return s.node < n; });
}

/** Calls f(arrays) with the arrays for the row of a special node: on the finest level (Real is
 * double), its weights may be the additional ones in double precision. */
template <class Real, class Arrays, class F>
void visitSpecial(const RowBlock::Header& h, const Arrays& a, const RowBlock::Special& node, F&& f)
{
  if constexpr (std::is_same_v<Real, double>)
  {
    if (node.precise >= 0)
    {
      f(a.ofPreciseRow(node, entriesOf(h, a, node.node).begin));
      return;
    }
  }
  f(a);
}

/** Divides nodes of a block, in order, into runs of ordinary nodes and single special ones:
 * `for (NodeRuns runs(h, a, nodes); runs.next();)`. */
class NodeRuns
{
public:
  template <class Arrays>
  NodeRuns(const RowBlock::Header& h, const Arrays& a, BlockRange nodes)
    : Special(specialFrom(h, a, nodes.begin))
    , Last(a.special + h.specials)
    , At(nodes.begin)
    , End(nodes.end)
  {
  }

  /** Moves to the next run; returns whether there is one. */
  bool next()
  {
    const std::int64_t stop = this->Special != this->Last
                                ? std::min<std::int64_t>(this->Special->node, this->End)
                                : this->End;
    if (this->At < stop)
    {
      this->Run = { this->At, stop };
      this->Found = nullptr;
    }
    else if (this->At < this->End)
    {
      this->Run = { this->At, this->At + 1 };
      this->Found = this->Special++;
    }
    else
    {
      return false;
    }
    this->At = this->Run.end;
    return true;
  }

  BlockRange nodes() const { return this->Run; }
  /** The special node that is the run; null: the nodes of the run are ordinary. */
  const RowBlock::Special* special() const { return this->Found; }

private:
  const RowBlock::Special *Special, *Last;
  const RowBlock::Special* Found = nullptr;
  std::int64_t At, End;
  BlockRange Run{};
};

/** Calls f(arrays, nodes, isSpecial) for runs of nodes of a block with the arrays of their rows:
 * special nodes come alone, with their weights in double precision if they have such. `isSpecial`
 * is a constant. */
template <class Real, class Arrays, class F>
[[gnu::always_inline]] inline void forRuns(
  const RowBlock::Header& h, const Arrays& a, BlockRange nodes, const F& f)
{
  for (NodeRuns runs(h, a, nodes); runs.next();)
  {
    if (!runs.special())
    {
      f(a, runs.nodes(), std::false_type());
      continue;
    }
    visitSpecial<Real>(
      h, a, *runs.special(), [&](const auto& row) { f(row, runs.nodes(), std::true_type()); });
  }
}

template <class Index, class Weight>
void RowBlock::sumDiagonals(const Arrays<Index, Weight>& a)
{
  const Header& h = this->header();
  // Users of a block see constant arrays; the diagonals are filled here.
  auto* diagonal = const_cast<double*>(a.diagonal);
  const double* rowSum = a.rowSum;
  const Weight* weight = a.weight;
  const Special* special = a.special;
  const Special* lastSpecial = a.special + h.specials;
  for (std::int32_t k = 0; k < h.nodes; ++k)
  {
    const auto group = static_cast<std::size_t>(k / Group);
    double sum = h.rowSumGroups >> group & 1 ? *rowSum++ : 0.0;
    const Weight* end = a.weight + h.entryStart[group] + a.entryEnd[k];
    // Special nodes are sorted: one step suffices, since k grows by one.
    special += special != lastSpecial && special->node < k ? 1 : 0;
    if (special != lastSpecial && special->node == k && special->precise >= 0)
    {
      // The precise weights stand for the floats of this row.
      for (const double* precise = a.precise + special->precise; weight < end; ++weight)
      {
        sum += *precise++;
      }
    }
    for (; weight < end; ++weight)
    {
      sum += static_cast<float>(*weight);
    }
    diagonal[k] = nonZeroDiagonal(sum);
  }
}

} // namespace smg
