// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Prefetch.h"
#include "Solver/Core/SimdPack.h"
#include "Solver/Files/ScratchStream.h"
#include "Solver/Memory/Buffer.h"
#include "Solver/Memory/Ring.h"
#include "Solver/Multigrid/Cycle/RowBlock.h"
#include "smg/Export.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace smg
{

/** The weights by which a pass accelerates the V-cycle T, which maps the iterate y_k to T(y_k). */
struct StepWeights
{
  /** y_{k+1} = y_k + correction (T(y_k) - y_k) + momentum (y_k - y_{k-1}). */
  double correction = 1.0, momentum = 0.0;
  /** The weights of conjugate residuals; see IterateHistory. */
  double conjugation = 0.0, length = 0.0;
  /** Whether conjugate residuals (re)start, with z_k = y_k. */
  bool begin = false;
};

/** Inner products of the vectors of conjugate residuals, summed over all columns. */
struct ResidualProducts
{
  double aa = 0.0, aq = 0.0, qq = 0.0, za = 0.0, zq = 0.0;
};

/** For which nodes conjugate residuals keep their vectors. */
enum class KeptResiduals
{
  None,
  Few,     ///< the smallest sample, where memory is short
  Sampled, ///< a sample that depends on the size of the level
  All      ///< for bad cells, where the residuals of few nodes dominate
};

/**
 * What acceleration keeps of the iterates of the finest level between passes: the step y_k -
 * y_{k-1} and, for conjugate residuals, three more vectors. They are in single precision, since
 * their rounding errors vanish with the steps as the iterates converge, and on disk if the level
 * is: per node and column 4 bytes, and 12 more for nodes with residuals.
 *
 * The iterates y_k are those whose residual a pass computes: after the sweeps before restriction.
 *
 * Conjugate residuals (Stiefel 1955; here with a V-cycle as preconditioner and one pass per step):
 * let z_k be the best combination of iterates so far, and y_k = T(z_{k-1}). The direction that y_k
 * adds has the image a = A (y_k - z_{k-1}) = r(z_{k-1}) - r(y_k), which is made conjugate to the
 * one before: q_k = a - conjugation q_{k-1}. Then r(z_k) = r(z_{k-1}) - length q_k. T is affine, so
 * T(z_k) needs no pass of its own: T(z_k) = y_k + length u_k with u_k = T(y_k) - y_k - conjugation
 * u_{k-1}, which is a step with a momentum.
 *
 * The stored vectors are r(z_k), called z below, q and a. Their inner products yield the weights of
 * the next pass before it starts; within a pass they would be known too late. On large meshes one
 * of up to sixteen groups of nodes is sampled, which determines the two weights of a step well
 * enough. Residuals differ between regions, so the groups are small (64 nodes) and spread over the
 * mesh.
 *
 * The inner products are summed in node order, so they do not depend on windows or threads.
 */
class SMG_EXPORT IterateHistory
{
public:
  /** For a level of `nodes` nodes with `columns` right-hand sides. */
  IterateHistory(Pool& pool, std::int64_t nodes, int columns, KeptResiduals residuals)
    : Nodes(nodes)
    , Columns(columns)
    , Stride(strideOf(columns))
    , Every(sparseness(nodes, residuals))
    , Before(pool, this->Stride)
    , Steps(pool, this->Stride)
    , Residuals(pool, this->Stride * Vectors)
    , Sums(static_cast<std::size_t>(Products * this->Stride))
    , Spare(pool)
    , Empty(pool)
  {
  }

  /** One of this many groups of nodes keeps residuals; 0: none does. */
  static std::int64_t sparseness(std::int64_t nodes, KeptResiduals residuals)
  {
    return residuals == KeptResiduals::Few       ? RowBlock::Groups
           : residuals == KeptResiduals::Sampled ? sparsenessFor(nodes)
           : residuals == KeptResiduals::All     ? 1
                                                 : 0;
  }
  std::int64_t sparseness() const { return this->Every; }

  /** The largest number of bytes per node in memory. */
  static std::int64_t nodeBytes(int stride, KeptResiduals residuals)
  {
    constexpr std::int64_t Single = sizeof(float);
    return stride * (std::int64_t(sizeof(double)) + Single +
                      (residuals != KeptResiduals::None ? Vectors * Single : 0));
  }

  /** Keeps the history in a scratch file in `folder`. */
  void useScratch(const ScratchFolder& folder, IoStatistics& statistics);
  bool keepsResiduals() const { return this->Every > 0; }

  void startPass(const StepWeights& weights);
  /** Loads the blocks up to node `end`, packed; keep() unpacks them. */
  void load(std::int64_t end);
  /** Copies y_k from x for the nodes that load() has loaded, before any stage of this pass
   * modifies them, and unpacks the loaded blocks. Other threads may access nodes below these. */
  void keep(const Ring<double>& x);
  /** Turns x of nodes [begin, end), which is T(y_k), into y_{k+1}. */
  void combine(const Ring<double>& x, std::int64_t begin, std::int64_t end);
  // Coarse levels, which have single precision, are not accelerated.
  void keep(const Ring<float>&) {}
  void combine(const Ring<float>&, std::int64_t, std::int64_t) {}

  /** Prefetches as many blocks as load() has taken since the last call. Other threads may access
   * loaded blocks. */
  void readAhead();
  /** Writes the blocks below `done`, whose residuals are known. Other threads may access blocks
   * above. */
  void write(std::int64_t done);
  /** Releases written blocks. */
  void release();
  void endPass();

  /** Between passes, with a scratch file: saves and restores all that later passes need. */
  void save(StateWriter& state);
  void load(StateReader& state);

  /** The inner products of the last pass. */
  ResidualProducts products() const;

private:
  template <class Vectors>
  friend class ResidualKeeper;

  static constexpr int Products = 5;
  static constexpr int Vectors = 3;
  static constexpr std::int64_t SampledNodes = std::int64_t(1) << 16;
  static constexpr std::int64_t ManyNodes = std::int64_t(1) << 23;

  /** The sampling interval of groups: a power of two, so that every block has the same number of
   * sampled groups. With one group in 16, levels of fewer than ManyNodes nodes converge more
   * slowly. */
  static std::int64_t sparsenessFor(std::int64_t nodes)
  {
    if (nodes >= ManyNodes)
    {
      return RowBlock::Groups;
    }
    const auto most = static_cast<std::uint64_t>(nodes / SampledNodes);
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::bit_floor(most)), 1, 8);
  }
  /** Which one of `Every` groups of a block is sampled: pseudo-random, so that it does not
   * correlate with a pattern of the mesh. */
  std::int64_t sampledGroup(std::int64_t block) const
  {
    constexpr std::uint32_t Golden = 2654435769U;
    return (static_cast<std::uint32_t>(block) * Golden >> 16) % this->Every;
  }
  /** The number of nodes below `end` that keep residuals: the index of the next such node in
   * Residuals. */
  std::int64_t sampledBelow(std::int64_t end) const
  {
    if (this->Every == 0)
    {
      return 0;
    }
    constexpr std::int64_t Group = RowBlock::Group;
    const std::int64_t block = end / RowBlock::Nodes;
    const std::int64_t inBlock = end % RowBlock::Nodes;
    const std::int64_t period = Group * this->Every;
    const std::int64_t inPeriod = inBlock % period - this->sampledGroup(block) * Group;
    return block * (RowBlock::Nodes / this->Every) + inBlock / period * Group +
           std::clamp<std::int64_t>(inPeriod, 0, Group);
  }
  std::int64_t blockEnd(std::int64_t begin) const
  {
    return std::min(this->Nodes, begin + RowBlock::Nodes);
  }
  Buffer readBlock();
  void loadBlock();
  // In memory each node has `Stride` values, on disk `Columns`.
  const float* unpack(
    Ring<float>& ring, std::int64_t begin, std::int64_t end, const float* packed) const;
  void pack(const Ring<float>& ring, std::int64_t begin, std::int64_t end);

  std::int64_t Nodes;
  int Columns;
  int Stride;
  std::int64_t Every; // one of this many groups of nodes keeps residuals; 0: none
  StepWeights Weights;
  Ring<double> Before;      // y_k, in double precision: T(y_k) - y_k is a small difference
  Ring<float> Steps;        // y_k - y_{k-1}
  Ring<float> Residuals;    // of sampled nodes: z, q and a, `Stride` values each
  std::vector<double> Sums; // the inner products of each lane
  bool First = true;
  std::int64_t Written = 0;
  std::optional<ScratchStream> Stream;
  std::int64_t Read = 0; // nodes of the blocks read so far; Ahead has those not taken yet
  Prefetch<Buffer> Ahead;
  std::vector<Buffer> Packages;        // loaded blocks that keep() has to unpack
  std::int64_t Kept = 0, Unpacked = 0; // ends of the nodes in Before and in Steps
  SpareBuffers Spare, Empty;
  std::vector<float> Packed;

  template <class Vectors>
  void combineLanes(const Ring<double>& x, std::int64_t begin, std::int64_t end, int lane);
};

/** Receives the residuals of y_{k+1} from restriction, in node order, for a block of the level
 * that begins with node `first`: the `Vectors::count` values from `lane` on. It does nothing
 * without a history that keeps residuals. */
template <class Vectors>
class ResidualKeeper
{
  using Wide = typename Vectors::Vector;
  using Single = SimdPack<float, Vectors::count>;
  using Narrow = typename Single::Vector;

public:
  ResidualKeeper(IterateHistory* history, std::int64_t first, int lane)
  {
    if (history && history->keepsResiduals())
    {
      this->Weights = history->Weights;
      this->Stride = history->Stride;
      this->Every = history->Every;
      this->Sampled = history->sampledGroup(first / RowBlock::Nodes);
      this->Kept = history->Residuals.at(history->sampledBelow(first)) + lane;
      this->Sums = history->Sums.data() + lane;
      for (int n = 0; n < IterateHistory::Products; ++n)
      {
        this->Sum[n] = Vectors::load(this->Sums + n * this->Stride);
      }
    }
  }
  ~ResidualKeeper()
  {
    for (int n = 0; this->Kept && n < IterateHistory::Products; ++n)
    {
      Vectors::store(this->Sums + n * this->Stride, this->Sum[n]);
    }
  }
  ResidualKeeper(const ResidualKeeper&) = delete;
  ResidualKeeper& operator=(const ResidualKeeper&) = delete;

  /** The residual of node first + k. */
  void operator()(std::int64_t k, Wide residual)
  {
    const std::int64_t group = k / RowBlock::Group;
    if (this->Kept && group % this->Every == this->Sampled)
    {
      const std::int64_t node = group / this->Every * RowBlock::Group + k % RowBlock::Group;
      this->add(this->Kept + IterateHistory::Vectors * node * this->Stride, residual);
    }
  }

private:
  void add(float* at, Wide residual)
  {
    const StepWeights& w = this->Weights;
    const Wide oldZ = __builtin_convertvector(Single::load(at), Wide);
    const Wide oldQ = __builtin_convertvector(Single::load(at + this->Stride), Wide);
    const Wide oldA = __builtin_convertvector(Single::load(at + 2 * this->Stride), Wide);
    // The recurrences of the class comment, from old z, q, a to the new ones.
    const Wide q = w.begin ? Wide{} : oldA - w.conjugation * oldQ;
    const Wide z = w.begin ? residual : oldZ - w.length * q;
    const Wide a = z - residual;
    Single::store(at, __builtin_convertvector(z, Narrow));
    Single::store(at + this->Stride, __builtin_convertvector(q, Narrow));
    Single::store(at + 2 * this->Stride, __builtin_convertvector(a, Narrow));
    this->Sum[0] += a * a;
    this->Sum[1] += a * q;
    this->Sum[2] += q * q;
    this->Sum[3] += z * a;
    this->Sum[4] += z * q;
  }

  StepWeights Weights;
  std::int64_t Stride = 0, Every = 1, Sampled = 0;
  float* Kept = nullptr;
  double* Sums = nullptr;
  Wide Sum[IterateHistory::Products] = {};
};

/** Coarse levels are not accelerated. */
template <int Count>
class ResidualKeeper<SimdPack<float, Count>>
{
public:
  ResidualKeeper(IterateHistory*, std::int64_t, int) {}
  void operator()(std::int64_t, typename SimdPack<float, Count>::Vector) {}
};

/**
 * The energy J(x) = 1/2 x.A x - b.x of the iterate of each pass, up to a constant. It needs no pass
 * of its own: restriction on the finest level has the residual r = b - A x, and J = -1/2 x.(b + r).
 * The squared energy norm of the error x* - x falls by twice what J falls, since A is symmetric.
 *
 * A large mean of the solution would drown this in rounding, so x is counted from a number c for
 * each column: with rowSum the row sums of A, -1/2 (x - c).(b - c rowSum + r) differs from J by a
 * constant. c is the mean of b / rowSum, weighted with |rowSum|, over the nodes of the first pass:
 * close to the prescribed values. Where all row sums are 0, c is the mean of x.
 */
class IterateEnergy
{
public:
  explicit IterateEnergy(int columns)
    : Stride(static_cast<std::size_t>(strideOf(columns)))
    , Numbers(5 * this->Stride)
  {
  }

  void startPass(bool first)
  {
    if (!first && !this->HasCentre)
    {
      this->HasCentre = true;
      for (std::size_t k = 0; k < this->Stride; ++k)
      {
        const auto mean = [&](std::size_t sum, std::size_t weights) {
          return this->Numbers[sum * this->Stride + k] / this->Numbers[weights * this->Stride + k];
        };
        const bool isHeld = this->Numbers[2 * this->Stride + k] > 0.0;
        const bool hasNodes = this->Numbers[4 * this->Stride + k] > 0.0;
        this->Numbers[k] = isHeld ? mean(1, 2) : hasNodes ? mean(3, 4) : 0.0;
      }
    }
    std::fill(
      this->Numbers.begin() + static_cast<std::ptrdiff_t>(this->Stride), this->Numbers.end(), 0.0);
  }

  /** Adds a node whose value is an unknown; `lane` is the first of the columns in the vectors. */
  template <class Vectors, class Vector>
  void add(const double* x, const double* b, const Vector& r, double rowSum, int lane)
  {
    double* centre = this->Numbers.data() + lane;
    double* sum = centre + this->Stride;
    if (!this->HasCentre)
    {
      const double weight = std::fabs(rowSum);
      const double sign = weight > 0.0 ? std::copysign(1.0, rowSum) : 0.0;
      Vectors::store(sum, Vectors::load(sum) + sign * Vectors::load(b));
      Vectors::store(sum + this->Stride, Vectors::load(sum + this->Stride) + weight);
      double* plain = sum + 2 * this->Stride;
      Vectors::store(plain, Vectors::load(plain) + Vectors::load(x));
      Vectors::store(plain + this->Stride, Vectors::load(plain + this->Stride) + 1.0);
      return;
    }
    const Vector c = Vectors::load(centre);
    Vectors::store(
      sum, Vectors::load(sum) - 0.5 * (Vectors::load(x) - c) * (Vectors::load(b) - rowSum * c + r));
  }

  /** The energy of the pass, summed over the columns; not of the first pass, which only finds c. */
  double value() const
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < this->Stride; ++k)
    {
      sum += this->Numbers[this->Stride + k];
    }
    return sum;
  }

  template <class State>
  void exchange(State& state)
  {
    state.part("energy");
    const std::size_t numbers = this->Numbers.size();
    state(this->HasCentre, this->Numbers);
    if constexpr (requires { state.require(true); })
    {
      state.require(this->Numbers.size() == numbers);
    }
  }

private:
  std::size_t Stride;
  std::vector<double> Numbers; ///< c; sums of the energy, or of +-b; of |rowSum|, of x, of 1
  bool HasCentre = false;
};

} // namespace smg
