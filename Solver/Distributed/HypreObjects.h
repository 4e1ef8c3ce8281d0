// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/Team.h"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** The rows of a matrix or vector of hypre that belong to this process. Numbers of vertices become
 * numbers of type HYPRE_BigInt. */
struct HypreRows
{
  /** Throws Error if hypre cannot count to `all`, or cannot count the entries of the rows from
   * `begin` to `end`. */
  HypreRows(std::int64_t begin, std::int64_t end, std::int64_t all);

  HYPRE_BigInt begin, end;
  HYPRE_Int count() const { return static_cast<HYPRE_Int>(this->end - this->begin); }
};

/** Throws Error if a function of hypre returned an error; `what` is what it was to do. */
void checkHypre(HYPRE_Int error, const char* what);

/** Owns an object of hypre, and releases it also if the constructor that makes it throws. */
template <class Object, auto Destroy>
struct HypreOwner
{
  HypreOwner() = default;
  ~HypreOwner()
  {
    if (this->object)
    {
      Destroy(this->object);
    }
  }
  HypreOwner(const HypreOwner&) = delete;
  HypreOwner& operator=(const HypreOwner&) = delete;
  operator Object() const { return this->object; }

  Object object = nullptr;
};

/** A square matrix of hypre. Constructor, assemble() and destructor are called on all processes. */
class HypreMatrix
{
public:
  /** Expects about `rowSize` entries in a row. */
  HypreMatrix(Team& team, const HypreRows& rows, HYPRE_Int rowSize);

  /** Adds numbers to a row of any process. */
  void add(HYPRE_BigInt row, std::span<const HYPRE_BigInt> columns, std::span<const double> values);
  void assemble();

  HYPRE_ParCSRMatrix parallel() const { return this->Parallel; }

private:
  Team& Processes;
  HypreOwner<HYPRE_IJMatrix, HYPRE_IJMatrixDestroy> Self;
  HYPRE_ParCSRMatrix Parallel = nullptr;
};

/** A vector of hypre. Constructor and destructor are called on all processes. */
class HypreVector
{
public:
  /** Zeroed. */
  HypreVector(Team& team, const HypreRows& rows);

  /** Sets and returns the numbers of the rows of this process. */
  void set(std::span<const double> values);
  void get(std::span<double> values) const;

  HYPRE_ParVector parallel() const { return this->Parallel; }

private:
  std::vector<HYPRE_BigInt> Numbers; ///< of the rows
  HypreOwner<HYPRE_IJVector, HYPRE_IJVectorDestroy> Self;
  HYPRE_ParVector Parallel = nullptr;
};

/** A V-cycle of BoomerAMG for a matrix, symmetric as conjugate gradients require. Constructor,
 * apply() and destructor are called on all processes. */
class BoomerAmg
{
public:
  /** Builds the hierarchy. `matrix` must outlive it; b and x are any vectors of its rows. */
  BoomerAmg(const HypreMatrix& matrix, const HypreVector& b, const HypreVector& x);

  /** x = M b. */
  void apply(const HypreVector& b, HypreVector& x) const;

private:
  const HypreMatrix& Matrix;
  HypreOwner<HYPRE_Solver, HYPRE_BoomerAMGDestroy> Self;
};

} // namespace smg
