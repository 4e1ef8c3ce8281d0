// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/GaussSeidel.h"
#include "Solver/Multigrid/Engine/Coarsening.h"
#include "Solver/Multigrid/Setup/GalerkinProduct.h"
#include "Solver/Multigrid/Setup/Interpolation.h"
#include "Solver/Multigrid/Setup/InterpolationRow.h"
#include "Solver/Multigrid/Setup/Sparsification.h"
#include "Testing/Support/EdgeWeights.h"
#include "Testing/Support/MemorySource.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace smg::testing
{

/** All rows of a level. */
struct TestLevel
{
  std::vector<std::vector<RowEntry>> rows;
  std::vector<double> rowSum;
  /** The weights of some rows in double precision; empty: none. */
  std::vector<std::vector<double>> precise;
  bool finest = true;        ///< otherwise coarsened from another level
  std::vector<float> points; ///< 3 per node, or none

  std::int64_t nodes() const { return static_cast<std::int64_t>(this->rows.size()); }

  float strongest(std::int64_t i) const
  {
    float largest = 0.0F;
    for (const RowEntry& entry : this->rows[i])
    {
      largest = std::max(largest, entry.weight());
    }
    return largest;
  }
  float least(std::int64_t i) const
  {
    float smallest = 0.0F;
    for (const RowEntry& entry : this->rows[i])
    {
      smallest = std::min(smallest, entry.weight());
    }
    return smallest;
  }

  std::span<const double> preciseOf(std::int64_t i) const
  {
    return this->precise.empty() ? std::span<const double>() : this->precise[i];
  }
  double weight(std::int64_t i, std::size_t e) const
  {
    const auto weights = this->preciseOf(i);
    return weights.empty() ? static_cast<double>(this->rows[i][e].weight()) : weights[e];
  }
  double diagonal(std::int64_t i) const
  {
    double sum = this->rowSum[i];
    for (std::size_t e = 0; e < this->rows[i].size(); ++e)
    {
      sum += this->weight(i, e);
    }
    return sum;
  }

  Eigen::MatrixXd dense() const
  {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(this->nodes(), this->nodes());
    for (std::int64_t i = 0; i < this->nodes(); ++i)
    {
      a(i, i) = this->diagonal(i);
      for (std::size_t e = 0; e < this->rows[i].size(); ++e)
      {
        a(i, i + this->rows[i][e].delta()) = -this->weight(i, e);
      }
    }
    return a;
  }

  /** Appends rows [begin, end) to the window of the level. `stiff` is called row by row. */
  void append(LevelRows& to, std::int64_t begin, std::int64_t end, SliverRows& stiff) const
  {
    for (std::int64_t i = begin; i < end; ++i)
    {
      const auto size = static_cast<std::int64_t>(this->rows[i].size());
      std::copy(this->rows[i].begin(), this->rows[i].end(), to.open(size));
      to.close(
        size, this->rowSum[i], this->finest ? -1 : 0, stiff(this->least(i)), this->preciseOf(i));
      if (!this->points.empty())
      {
        std::copy_n(this->points.begin() + 3 * i, 3, to.place(1));
      }
    }
  }
  void append(LevelRows& to, std::int64_t begin, std::int64_t end) const
  {
    SliverRows none;
    this->append(to, begin, end, none);
  }
};

inline TestLevel levelOf(const LevelRows& rows)
{
  TestLevel level;
  for (std::int64_t i = 0; i < rows.end(); ++i)
  {
    const auto row = rows.row(i);
    level.rows.emplace_back(row.begin(), row.end());
    level.rowSum.push_back(rows.rowSum(i));
    if (rows.isPlaced())
    {
      level.points.insert(level.points.end(), rows.point(i), rows.point(i) + 3);
    }
  }
  return level;
}

/**
 * The finest level of a mesh. Every `every`-th vertex is constrained: it has an empty row, and its
 * neighbours have its weight in rowSum; 0: none is.
 */
inline TestLevel finestLevel(const StreamMesh& mesh, Weights weights, std::int64_t every = 0)
{
  MemorySource source(mesh);
  EdgeWeights edges(source.info(), weights);
  MeshBlock block;
  while (source.next(block))
  {
    edges.add(block, mesh.positions);
  }
  edges.finish(mesh.positions);
  TestLevel level;
  level.rows.resize(mesh.vertices());
  level.rowSum.resize(mesh.vertices());
  const auto isFixed = [&](std::int64_t v) { return every > 0 && v % every == every / 2; };
  const auto add = [&](std::int64_t i, std::int64_t j, double weight)
  {
    if (isFixed(i))
    {
      level.rowSum[i] = 1.0;
    }
    else if (isFixed(j))
    {
      level.rowSum[i] += static_cast<float>(weight);
    }
    else
    {
      level.rows[i].push_back({ static_cast<std::int32_t>(j - i), static_cast<float>(weight) });
    }
  };
  for (const EdgeWeight& edge : edges.edges())
  {
    add(edge.from, edge.to, edge.weight);
    add(edge.to, edge.from, edge.weight);
  }
  for (auto& row : level.rows)
  {
    std::sort(row.begin(), row.end(),
      [](const RowEntry& a, const RowEntry& b) { return a.delta() < b.delta(); });
  }
  return level;
}

/** A record of a coarsening, for checks after its windows have been released. */
struct CoarseningRecord
{
  struct Parent
  {
    std::int64_t coarse;
    int quanta;
    bool operator==(const Parent&) const = default;
  };
  /** A row of P during relaxation. */
  struct Relaxed
  {
    std::vector<std::pair<std::int64_t, float>> entries; ///< coarse node, weight
    float sum = 0.0F;
  };
  std::vector<std::int64_t> coarseIndex;    ///< coarse node of each fine node, or -1
  std::vector<std::vector<Relaxed>> sweeps; ///< the rows after each sweep, from that of P0
  std::vector<std::vector<Parent>> parents;
  TestLevel raw; ///< P^T A P before sparsification
  std::vector<bool> rawStiff;

  /** Records row i of P, which was just appended. */
  void addParents(const CoarseningData& data, std::int64_t i)
  {
    auto& row = this->parents.emplace_back();
    const InterpolationEntry* entry = data.interpolation.row(i);
    for (std::int64_t e = 0; e < data.interpolation.size(i); ++e)
    {
      const std::int64_t near = data.coarseNodes;
      row.push_back({ near + entry[e].offset(near), entry[e].quanta() });
    }
  }
  /** Records row c of the product before sparsification. */
  void addRaw(const CoarseningData& data, std::int64_t c)
  {
    auto& row = this->raw.rows.emplace_back();
    const CoarseEntry* entry = data.raw.row(c);
    for (const CoarseEntry* end = entry + data.raw.size(c); entry != end; ++entry)
    {
      row.push_back({ entry->offset(c), entry->value() });
    }
    this->raw.rowSum.push_back(data.rawRowSum[c]);
    this->rawStiff.push_back(data.rawStrongest[c].stiff());
  }

  std::int64_t coarseNodes() const { return this->raw.nodes(); }
  Eigen::MatrixXd interpolation() const
  {
    Eigen::MatrixXd p = Eigen::MatrixXd::Zero(this->parents.size(), this->coarseNodes());
    for (std::size_t i = 0; i < this->parents.size(); ++i)
    {
      for (const Parent& parent : this->parents[i])
      {
        p(i, parent.coarse) += parent.quanta / 127.0;
      }
    }
    return p;
  }
};

/** An operator set of the default parts with given parameters, which keeps a record. */
class RecordingOperators
{
public:
  static constexpr const char* name = "recording";
  using Relaxation = GaussSeidel;
  static RecordingOperators forCells(CellType) { return {}; }

  float strength = 0.1F;
  float cancellingStrength = 0.1F;
  int finestEntries = 4;
  int entries = 4;
  int sweeps = 2;
  double cancelling = 1.5;
  float tolerance = 0.1F; ///< of sparsification; 0: the raw product
  bool dropsNegative = false;
  int rings = 1; ///< of patches; 2: the finest level has overlapping ones
  std::shared_ptr<CoarseningRecord> record = std::make_shared<CoarseningRecord>();

  int patchRings() const { return this->rings; }
  bool isCoarse(const CoarseningData& data, std::int64_t i)
  {
    this->Interpolation.coarsePoints.strength = this->strength;
    this->Interpolation.coarsePoints.cancellingStrength = this->cancellingStrength;
    this->Interpolation.finestEntries = this->finestEntries;
    this->Interpolation.entries = this->entries;
    this->Product.cancelling = this->cancelling;
    const bool isCoarse = this->Interpolation.coarsePoints(data, i);
    this->record->coarseIndex.push_back(isCoarse ? data.coarseNodes : -1);
    this->Turns.push_back(0);
    return isCoarse;
  }
  void interpolateInitial(CoarseningData& data, std::int64_t i)
  {
    this->Interpolation.initial(data, i);
    this->keep(data, data.initial.row(i), data.initial.size(i), data.initialSum(i), 0, i);
  }
  int interpolationSweeps() const { return this->sweeps; }
  void relaxInterpolation(CoarseningData& data, std::int64_t i)
  {
    this->Interpolation.relax(data, i);
    const auto sweep = static_cast<std::size_t>(++this->Turns[i]);
    const Patch* patch = data.patches.of(i);
    for (int k = 0; k < (patch ? patch->size : 1); ++k)
    {
      const std::int64_t m = patch ? patch->member(k) : i;
      const RelaxedRow& row = data.relaxed[m];
      if (m <= i && row.size != RelaxedRow::Pending)
      {
        this->keep(data, row.entry, row.size, row.sum, sweep, m);
      }
    }
  }
  void interpolate(CoarseningData& data, std::int64_t i)
  {
    appendRounded(data, i, data.relaxed[i]);
    this->record->addParents(data, i);
  }
  void productAP(CoarseningData& data, std::int64_t i) { this->Product.productAP(data, i); }
  void productPtAP(CoarseningData& data, std::int64_t c) { this->Product.productPtAP(data, c); }
  void sparsify(CoarseningData& data, std::int64_t c) const
  {
    this->record->addRaw(data, c);
    Sparsification{ this->tolerance, this->dropsNegative }(data, c);
  }

private:
  void keep(const CoarseningData& data, const CoarseEntry* entry, std::int64_t size, float sum,
    std::size_t sweep, std::int64_t i)
  {
    auto& sweeps = this->record->sweeps;
    sweeps.resize(std::max(sweeps.size(), sweep + 1));
    sweeps[sweep].resize(std::max(sweeps[sweep].size(), static_cast<std::size_t>(i + 1)));
    auto& row = sweeps[sweep][i];
    row = { {}, sum };
    for (std::int64_t e = 0; e < size; ++e)
    {
      const std::int64_t near = data.coarseNodes;
      row.entries.emplace_back(near + entry[e].offset(near), entry[e].value());
    }
  }

  ExtendedInterpolation Interpolation;
  GalerkinProduct Product;
  std::vector<int> Turns; // number of relaxations of each node
};

static_assert(OperatorSet<RecordingOperators>);

/** A level, the record of its coarsening, and the next level. */
struct CoarsenedLevel
{
  TestLevel fine;
  CoarseningRecord record;
  TestLevel coarse;
};

/** Coarsens a level whose rows are appended in batches; copies are kept as in a solve. The
 * operators have a `record`. */
template <OperatorSet Operators = RecordingOperators>
CoarsenedLevel coarsen(const TestLevel& fine, Operators operators,
  std::int64_t batch = std::numeric_limits<std::int64_t>::max(), SliverRows stiff = {})
{
  operators.record = std::make_shared<CoarseningRecord>();
  Pool pool(std::int64_t(1) << 32);
  LevelRows fineRows(pool);
  LevelRows coarseRows(pool);
  Coarsening<Operators> step(pool, operators, fineRows, coarseRows, stiff);
  for (std::int64_t begin = 0; begin < fine.nodes();)
  {
    const std::int64_t end = begin + std::min(batch, fine.nodes() - begin);
    fine.append(fineRows, begin, end, stiff);
    fineRows.Ended = end == fine.nodes();
    step.advance();
    step.handOver();
    step.packed(step.multiplied());
    step.release();
    begin = end;
  }
  EXPECT_TRUE(coarseRows.Ended);
  return { fine, *operators.record, levelOf(coarseRows) };
}

} // namespace smg::testing
