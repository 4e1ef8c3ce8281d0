// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/RowBlockPacker.h"
#include "Solver/Multigrid/Cycle/VCycle.h"
#include "Testing/Solver/PatchReference.h"
#include "Testing/Support/AllIndices.h"

#include <memory>
#include <vector>

namespace smg::testing
{

/** A copy of a narrow block with wide indices. */
template <class Weight>
RowBlock widened(Pool& pool, const RowBlock& narrow)
{
  RowBlock::Header h = narrow.header();
  const auto from = narrow.arrays<std::int16_t, Weight>();
  h.wide = 1;
  Buffer buffer(pool, RowBlock::storedBytes(h) + RowBlock::diagonalBytes(h.nodes));
  *reinterpret_cast<RowBlock::Header*>(buffer.data()) = h;
  RowBlock wide(std::move(buffer));
  const auto to = wide.arrays<WideIndex, Weight>();
  const auto copy = [](const auto* source, std::int32_t count, const auto* target)
  {
    using Target = std::remove_const_t<std::remove_pointer_t<decltype(target)>>;
    std::transform(source, source + count, const_cast<Target*>(target),
      [](auto value) { return static_cast<Target>(value); });
  };
  copy(from.weight, h.entries, to.weight);
  copy(from.delta, h.entries, to.delta);
  copy(from.parent, h.parents, to.parent);
  copy(from.entryEnd, h.nodes, to.entryEnd);
  copy(from.parentEnd, h.nodes, to.parentEnd);
  copy(from.parentQuanta, h.parents, to.parentQuanta);
  copy(from.rowSum, RowBlock::rowSums(h), to.rowSum);
  copy(from.special, h.specials, to.special);
  copy(from.value, h.values, to.value);
  copy(from.precise, h.precise, to.precise);
  copy(from.diagonal, h.nodes, to.diagonal);
  return wide;
}

inline bool roundsWeights(const RowBlock& block)
{
  return block.header().weightBytes == sizeof(BFloat16);
}

/** Rounds the off-diagonals of the rows like the block, preserving the row sums. */
inline void roundRows(const RowBlock& block, Eigen::MatrixXd& matrix)
{
  for (Eigen::Index i = block.first(); roundsWeights(block) && i < block.end(); ++i)
  {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    {
      if (j != i)
      {
        const double value = BFloat16(static_cast<float>(matrix(i, j)));
        matrix(i, i) += matrix(i, j) - value;
        matrix(i, j) = value;
      }
    }
  }
}

/**
 * A hierarchy of levels in memory, as used by the core cycle, with dense copies of its operators.
 */
template <class Real = float>
class DenseHierarchy
{
public:
  using TestedLevel = Level<Real>;
  using CoarserLevel = Level<float>;

  /** `rings`: of the patches; 2: the finest level has overlapping ones. */
  DenseHierarchy(
    const TestLevel& finest, int levels, int columns, int sweeps, bool wide = false, int rings = 1)
    : Memory(std::int64_t(1) << 32)
  {
    std::vector<std::unique_ptr<LevelRows>> rows;
    std::vector<std::unique_ptr<Coarsening<RecordingOperators>>> steps;
    rows.push_back(std::make_unique<LevelRows>(this->Memory));
    finest.append(*rows[0], 0, finest.nodes());
    rows[0]->Ended = true;
    for (int l = 0; l + 1 < levels; ++l)
    {
      RecordingOperators operators;
      operators.rings = rings;
      rows.push_back(std::make_unique<LevelRows>(this->Memory));
      steps.push_back(std::make_unique<Coarsening<RecordingOperators>>(
        this->Memory, operators, *rows[l], *rows[l + 1]));
      steps.back()->advance();
      steps.back()->handOver();
      this->Records.push_back(operators.record);
    }
    for (int l = 0; l < levels; ++l)
    {
      const TestLevel level = l > 0 ? levelOf(*rows[l]) : finest;
      this->Matrices.push_back(level.dense());
      // The coarsest level is solved directly and has no patches.
      this->PatchLists.push_back(l + 1 < levels ? patchesOf(level, rings) : PatchList{});
      if (l > 0)
      {
        this->Coarse.push_back(std::make_unique<CoarserLevel>(
          this->Memory, this->Resident, l, columns, sweeps, compiledRelaxation<GaussSeidel>));
        this->Coarse.back()->setCore();
      }
    }
    if (rings > 1)
    {
      this->Overlapping = overlappingPatchesOf(finest, rings);
    }
    this->Finest = std::make_unique<TestedLevel>(
      this->Memory, this->Resident, 0, columns, sweeps, compiledRelaxation<GaussSeidel>);
    this->Finest->setCore();
    SpareBuffers buffers(this->Memory);
    const auto fill = [&](auto& level, int l)
    {
      const CoarseningData* data = l + 1 < levels ? &steps[l]->data() : nullptr;
      for (std::int64_t begin = 0; begin < rows[l]->end(); begin += RowBlock::Nodes)
      {
        const std::int64_t nodes = std::min(RowBlock::Nodes, rows[l]->end() - begin);
        RowBlock block = packRows(buffers, *rows[l], data, begin, nodes, mayRound(l));
        roundRows(block, this->Matrices[l]);
        if (wide)
        {
          block = roundsWeights(block) ? widened<BFloat16>(this->Memory, block)
                                       : widened<float>(this->Memory, block);
        }
        level.append(std::move(block));
      }
      if (data)
      {
        level.setCoarse(this->Coarse[l].get());
      }
    };
    fill(*this->Finest, 0);
    for (int l = 1; l < levels; ++l)
    {
      fill(*this->Coarse[l - 1], l);
    }
  }

  TestedLevel& finest() { return *this->Finest; }
  CoarserLevel& coarse(int l) { return *this->Coarse[l - 1]; }
  const Eigen::MatrixXd& matrix(int l) const { return this->Matrices[l]; }
  const PatchList& patches(int l) const { return this->PatchLists[l]; }
  /** The overlapping patches of the finest level by their last members; or none. */
  const std::vector<PatchList>& overlapping() const { return this->Overlapping; }
  Eigen::MatrixXd interpolation(int l) const { return this->Records[l]->interpolation(); }

private:
  static bool mayRound(int l) { return l > 0 || std::is_same_v<Real, float>; }

  Pool Memory;
  ResidentNodes Resident;
  std::vector<Eigen::MatrixXd> Matrices;
  std::vector<PatchList> PatchLists;
  std::vector<PatchList> Overlapping;
  std::vector<std::shared_ptr<CoarseningRecord>> Records;
  std::unique_ptr<TestedLevel> Finest;
  std::vector<std::unique_ptr<CoarserLevel>> Coarse;
};

/** Converts the state of a level to a matrix with one row per node, and back. */
template <class Real>
Eigen::MatrixXd stateOf(const Ring<Real>& state, int columns)
{
  Eigen::MatrixXd values(state.end(), columns);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
  {
    for (int k = 0; k < columns; ++k)
    {
      values(i, k) = state.at(i)[k];
    }
  }
  return values;
}

template <class Real>
void setState(Ring<Real>& state, const Eigen::MatrixXd& values)
{
  std::ranges::fill(state.range(0, state.end()), Real{});
  for (Eigen::Index i = 0; i < values.rows(); ++i)
  {
    for (Eigen::Index k = 0; k < values.cols(); ++k)
    {
      state.at(i)[k] = static_cast<Real>(values(i, k));
    }
  }
}

/** Solves the equations of a patch. */
inline void denseSolve(const Eigen::MatrixXd& a, const std::vector<std::int64_t>& patch,
  const Eigen::MatrixXd& b, Eigen::MatrixXd& x)
{
  const Eigen::MatrixXd residual = b(patch, AllIndices) - a(patch, AllIndices) * x;
  x(patch, AllIndices) += partOf(a, patch).inverse() * residual;
}

/** One forward Gauss-Seidel sweep; a patch, if there are any, is solved when its last node is
 * reached, and after it the overlapping ones that end there. */
inline void denseSweep(const Eigen::MatrixXd& a, const PatchList& patches, const Eigen::MatrixXd& b,
  Eigen::MatrixXd& x, const std::vector<PatchList>& overlapping = {})
{
  for (Eigen::Index i = 0; i < a.rows(); ++i)
  {
    const std::vector<std::int64_t> alone{ i };
    const auto& patch = patches.empty() ? alone : patches[i];
    if (patch.size() == 1 || nearlySingular(partOf(a, patch), 1e-9))
    {
      x.row(i) += (b.row(i) - a.row(i) * x) / a(i, i);
    }
    else if (patch.back() == i)
    {
      denseSolve(a, patch, b, x);
    }
    for (const auto& members : overlapping.empty() ? PatchList{} : overlapping[i])
    {
      denseSolve(a, members, b, x);
    }
  }
}

inline Eigen::MatrixXd randomMatrix(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed)
{
  Random random(seed);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.uniform(-1.0, 1.0); });
}

} // namespace smg::testing
