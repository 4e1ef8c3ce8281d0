// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/GaussSeidel.h"
#include "Solver/Multigrid/OperatorSet.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "Solver/Multigrid/Setup/GalerkinProduct.h"
#include "Solver/Multigrid/Setup/InterpolationRow.h"
#include "Solver/Multigrid/Setup/Sparsification.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** Row i of a level's matrix A, as operators of one's own see it. A_ii is diagonal(), A_ij is minus
 * the weight of neighbour j. */
class FineRow
{
public:
  struct Neighbour
  {
    float weight; ///< of the edge: -A_ij
    /** Whether j is a C-point; while C-points are chosen, known of neighbours before i alone. */
    bool isCoarse;
    CoarseIndex coarse; ///< its coarse node, if it is a C-point
  };

  /** `chosen`: nodes below this one have been split into C-points and F-points. */
  FineRow(const CoarseningData& data, std::int64_t i, std::int64_t chosen)
    : Data(&data)
    , Row(i)
    , Chosen(chosen)
  {
  }

  float diagonal() const { return this->Data->patches.diagonal(this->Row); }
  /** The sum of the row: 0 where no constraint reaches. */
  double rowSum() const { return this->Data->fine.rowSum(this->Row); }
  /** The largest weight, 0 without neighbours. */
  float strongest() const { return this->Data->fine.strongest(this->Row); }
  /** Whether the row is stiff (a large negative weight, of slivers): then it should be a C-point.
   */
  bool isStiff() const { return this->Data->fine.stiff(this->Row); }
  bool empty() const { return this->Data->fine.row(this->Row).empty(); }

  class Neighbours;
  /** Made as they are read. */
  Neighbours neighbours() const;

private:
  Neighbour seen(const RowEntry& entry) const
  {
    const std::int64_t node = this->Row + entry.delta();
    const CoarseIndex coarse =
      node < this->Chosen ? this->Data->coarseIndex[node] : CoarseningData::FPoint;
    return { entry.weight(), coarse != CoarseningData::FPoint, coarse };
  }

  const CoarseningData* Data;
  std::int64_t Row, Chosen;
};

/** A range of the neighbours of a row. (The views of the standard library need a newer Clang than
 * some systems have.) */
class FineRow::Neighbours
{
public:
  explicit Neighbours(const FineRow& row)
    : Row(row)
  {
  }

  class Iterator
  {
  public:
    using value_type = Neighbour;
    using difference_type = std::ptrdiff_t;

    Iterator() = default;
    Iterator(const FineRow& row, const RowEntry* entry)
      : Row(&row)
      , Entry(entry)
    {
    }
    Neighbour operator*() const { return this->Row->seen(*this->Entry); }
    Iterator& operator++()
    {
      ++this->Entry;
      return *this;
    }
    Iterator operator++(int) { return { *this->Row, this->Entry++ }; }
    bool operator==(const Iterator& other) const { return this->Entry == other.Entry; }

  private:
    const FineRow* Row = nullptr;
    const RowEntry* Entry = nullptr;
  };

  /** Valid as long as this. */
  Iterator begin() const { return { this->Row, this->entries().data() }; }
  Iterator end() const
  {
    const std::span<const RowEntry> entries = this->entries();
    return { this->Row, entries.data() + entries.size() };
  }

private:
  std::span<const RowEntry> entries() const { return this->Row.Data->fine.row(this->Row.Row); }

  FineRow Row;
};

inline FineRow::Neighbours FineRow::neighbours() const
{
  return Neighbours(*this);
}

/** A row of the interpolation P that is being made: append() adds what the node takes from a coarse
 * node. The RelaxedRow::Most entries of the largest magnitudes stay, scaled to the sum of all. */
class InterpolationWeights
{
public:
  void append(CoarseIndex coarse, double weight)
  {
    this->Total += weight;
    int place = std::min(this->Size, RelaxedRow::Most);
    for (; place > 0 && std::fabs(this->Entry[place - 1].weight) < std::fabs(weight); --place)
    {
      this->Entry[place] = this->Entry[place - 1];
    }
    if (place < RelaxedRow::Most)
    {
      this->Entry[place] = { coarse, weight };
      this->Size = std::min(this->Size + 1, RelaxedRow::Most);
    }
  }

  /** The row, scaled to the sum of all weights. */
  RelaxedRow row() const
  {
    double kept = 0.0;
    for (int k = 0; k < this->Size; ++k)
    {
      kept += this->Entry[k].weight;
    }
    const double scale = kept != 0.0 ? this->Total / kept : 0.0;
    RelaxedRow row;
    row.sum = static_cast<float>(this->Total);
    row.size = static_cast<std::int8_t>(this->Size);
    for (int k = 0; k < this->Size; ++k)
    {
      row.entry[k] = { this->Entry[k].coarse, static_cast<float>(scale * this->Entry[k].weight) };
    }
    return row;
  }

private:
  struct Weight
  {
    CoarseIndex coarse;
    double weight;
  };
  Weight Entry[RelaxedRow::Most + 1]; // by descending magnitude, and room to insert
  int Size = 0;
  double Total = 0.0;
};

/**
 * An operator set in terms of rows. Derive Own from RowOperators<Own> and give it
 *
 *   static constexpr const char* name
 *   bool isCPoint(const FineRow& row) const             whether the node is a C-point
 *   void weightsOf(const FineRow& row, InterpolationWeights& P) const   the row of P of an F-point
 *
 * for nodes in ascending order. A node without neighbours must be an F-point, and an F-point with
 * neighbours should have a C-point among them: P reaches no farther. The coarse operator is the
 * sparsified Galerkin product and relaxation is Gauss-Seidel; a member of the same name in Own
 * replaces each (see OperatorSet). Own must be default-constructible, and the functions must depend
 * on their row alone: several threads may call them.
 */
template <class Own>
class RowOperators
{
public:
  using Relaxation = GaussSeidel;
  using Apart = Own;
  static Own forCells(CellType) { return {}; }

  bool isCoarse(const CoarseningData& data, std::int64_t i) const
  {
    return this->own().isCPoint(FineRow(data, i, i));
  }
  /** Rows of P are final at once: there is nothing to relax. */
  void interpolateInitial(CoarseningData& data, std::int64_t i) const
  {
    data.initial.open(0);
    data.initial.close(0);
    data.initialTotal.extendRaw(i + 1);
    data.initialTotal[i] = 1.0F;
  }
  int interpolationSweeps() const { return 1; }
  void relaxInterpolation(CoarseningData& data, std::int64_t i) const
  {
    data.relaxed[i].size = 0;
    data.relaxed[i].sum = 0.0F;
  }
  void interpolate(CoarseningData& data, std::int64_t i) const
  {
    InterpolationWeights weights;
    if (data.coarseIndex[i] != CoarseningData::FPoint)
    {
      weights.append(data.coarseIndex[i], 1.0);
    }
    else
    {
      this->own().weightsOf(FineRow(data, i, data.fine.reach(i) + 1), weights);
    }
    appendRounded(data, i, weights.row());
  }
  void productAP(CoarseningData& data, std::int64_t i) { this->Product.productAP(data, i); }
  void productPtAP(CoarseningData& data, std::int64_t c) { this->Product.productPtAP(data, c); }
  void sparsify(CoarseningData& data, std::int64_t c) const { this->Sparsify(data, c); }

private:
  const Own& own() const { return static_cast<const Own&>(*this); }

  GalerkinProduct Product;
  Sparsification Sparsify;
};

} // namespace smg
