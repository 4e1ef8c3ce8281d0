// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/Lanes.h"
#include "Solver/Storage/Ring.h"
#include "Solver/Storage/ScratchStream.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <type_traits>
#include <vector>

namespace smg
{

/** How a pass goes beyond the V-cycle T, which takes the iterate y_k to T(y_k). */
struct StepWeights
{
  /** y_{k+1} = y_k + correction (T(y_k) - y_k) + momentum (y_k - y_{k-1}). */
  double correction = 1.0, momentum = 0.0;
  /** Of the directions of conjugate residuals; see IterateHistory. */
  double conjugation = 0.0, length = 0.0;
  /** Conjugate residuals begin: z_k = y_k. */
  bool begin = false;
};

/** Sums over all values of the products of the vectors of conjugate residuals. */
struct ResidualProducts
{
  double aa = 0.0, aq = 0.0, qq = 0.0, za = 0.0, zq = 0.0;
};

/**
 * What acceleration keeps of the finest level's iterates from pass to pass: of each value the step
 * y_k - y_{k-1} and, for conjugate residuals, three vectors more. In single precision, for their
 * rounding is relative to what vanishes as the iterates converge; on disk if the level is.
 *
 * The iterates y_k are those whose residual a pass measures: after the sweeps of the way down.
 *
 * Conjugate residuals (Stiefel 1955; with a V-cycle as preconditioner, one pass a step): let z_k be
 * the best combination of iterates so far and y_k = T(z_{k-1}). The direction that y_k adds has the
 * image a = A (y_k - z_{k-1}) = r(z_{k-1}) - r(y_k), made conjugate: q_k = a - conjugation q_{k-1}.
 * Then r(z_k) = r(z_{k-1}) - length q_k. As T is affine, T(z_k) needs no pass of its own:
 * T(z_k) = y_k + length u_k, u_k = T(y_k) - y_k - conjugation u_{k-1}, which is a step with a
 * momentum. Kept are z: r(z_k), q and a; their products give the next weights before the next pass.
 */
class IterateHistory
{
public:
  IterateHistory(Pool& pool, int stride, bool residuals)
    : Stride(stride)
    , Vectors(vectors(residuals))
    , Before(pool, stride)
    , Kept(pool, stride * this->Vectors)
    , Sums(static_cast<std::size_t>(5 * stride))
  {
  }

  /** Bytes of a node in memory. */
  static std::int64_t nodeBytes(int stride, bool residuals)
  {
    return stride * static_cast<std::int64_t>(sizeof(double) + vectors(residuals) * sizeof(float));
  }

  /** Keeps the history in a scratch file in `folder`. */
  void useScratch(const std::filesystem::path& folder, IoStatistics& statistics);
  bool keepsResiduals() const { return this->Vectors > 1; }

  void startPass(const StepWeights& weights);
  /** Remembers the iterate x of nodes below `end`, which are loaded and not touched yet. */
  void load(const Ring<double>& x, std::int64_t end);
  /** x of nodes [begin, end), which is T(y_k), becomes y_{k+1}. */
  void combine(const Ring<double>& x, std::int64_t begin, std::int64_t end);
  // Levels of single precision, the coarse ones, are not accelerated.
  void load(const Ring<float>&, std::int64_t) {}
  void combine(const Ring<float>&, std::int64_t, std::int64_t) {}

  /** Takes the residual of y_{k+1} of node i, the values from `lane` on. Nodes in order. */
  template <class Vectors>
  void addResidual(std::int64_t i, int lane, typename Vectors::Vector residual);
  /** Writes and lets go of the blocks below `done`, whose residuals have come. */
  void write(std::int64_t done);
  void endPass();

  /** Of the last pass. */
  ResidualProducts products() const;

private:
  static constexpr int vectors(bool residuals) { return residuals ? 4 : 1; }

  int Stride;
  int Vectors;
  StepWeights Weights;
  Ring<double> Before; // y_k
  Ring<float> Kept;    // a node: step, then z, q and a, `Stride` values each
  std::vector<double> Sums;
  bool First = true;
  std::int64_t Written = 0;
  std::optional<ScratchStream> Stream;
};

template <class Vectors>
void IterateHistory::addResidual(std::int64_t i, int lane, typename Vectors::Vector residual)
{
  using Wide = typename Vectors::Vector;
  using Single = Lanes<float, Vectors::count>;
  float* z = this->Kept.at(i) + this->Stride + lane;
  float* q = z + this->Stride;
  float* a = q + this->Stride;
  const Wide oldZ = __builtin_convertvector(Single::load(z), Wide);
  const Wide oldQ = __builtin_convertvector(Single::load(q), Wide);
  const Wide oldA = __builtin_convertvector(Single::load(a), Wide);
  const StepWeights& w = this->Weights;
  const Wide newQ = w.begin ? Wide{} : oldA - w.conjugation * oldQ;
  const Wide newZ = w.begin ? residual : oldZ - w.length * newQ;
  const Wide newA = newZ - residual;
  Single::store(z, __builtin_convertvector(newZ, typename Single::Vector));
  Single::store(q, __builtin_convertvector(newQ, typename Single::Vector));
  Single::store(a, __builtin_convertvector(newA, typename Single::Vector));
  double* sum = this->Sums.data() + lane;
  for (const Wide& product : { newA * newA, newA * newQ, newQ * newQ, newZ * newA, newZ * newQ })
  {
    Vectors::store(sum, Vectors::load(sum) + product);
    sum += this->Stride;
  }
}

/** What restriction does with the residuals of the block of a level that begins with node `first`.
 */
template <class Vectors>
auto keeping(IterateHistory* history, std::int64_t first, int lane)
{
  IterateHistory* const keeper = history && history->keepsResiduals() ? history : nullptr;
  return [=](std::int64_t k, typename Vectors::Vector residual)
  {
    if constexpr (std::is_same_v<typename Vectors::Value, double>)
    {
      if (keeper)
      {
        keeper->addResidual<Vectors>(first + k, lane, residual);
      }
    }
  };
}

} // namespace smg
