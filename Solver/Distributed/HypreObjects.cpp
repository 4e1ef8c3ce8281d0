// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/HypreObjects.h"

#include "Solver/Distributed/PartMemory.h"

#include <limits>
#include <numeric>
#include <string>

// The objects of hypre that are used here, as classes: their owners release them also if a
// constructor throws, and every error code becomes an Error.

namespace smg
{

HypreRows::HypreRows(std::int64_t first, std::int64_t last, std::int64_t all)
  : begin(static_cast<HYPRE_BigInt>(first))
  , end(static_cast<HYPRE_BigInt>(last))
{
  // HYPRE_BigInt numbers the rows of all processes; HYPRE_Int counts what one process has.
  if (all > static_cast<std::int64_t>(std::numeric_limits<HYPRE_BigInt>::max()))
  {
    throw Error("the mesh has " + std::to_string(all) +
                " vertices, more than this build of hypre can count: build with a hypre that has "
                "64-bit or mixed integers, or use the streaming engine");
  }
  if (last - first > maxPartVertices())
  {
    throw Error("a process has " + std::to_string(last - first) + " vertices, more than the " +
                std::to_string(maxPartVertices()) +
                " that this build of hypre can have in a process: use more processes");
  }
}

/** hypre keeps an error until it is cleared, and returns it from later functions as well. */
void checkHypre(HYPRE_Int error, const char* what)
{
  if (error != 0)
  {
    char text[256] = "";
    HYPRE_DescribeError(error, text);
    HYPRE_ClearAllErrors();
    throw Error(std::string("hypre could not ") + what + ": " + text);
  }
}

HypreMatrix::HypreMatrix(Team& team, const HypreRows& rows, HYPRE_Int rowSize)
  : Processes(team)
{
  // An error that another user of hypre has left would be taken for one of the next calls.
  HYPRE_ClearAllErrors();
  // hypre does not count its users. It is started once and kept to the end of the program, in which
  // another library may be using it.
  static const HYPRE_Int started = HYPRE_Init();
  checkHypre(started, "start");
  // The usual number of entries of a row. Rows may have more, for which hypre allocates; with a
  // good guess it rarely has to.
  const std::vector<HYPRE_Int> sizes(static_cast<std::size_t>(rows.count()), rowSize);
  team.agree();
  // A process has a contiguous range of rows, and the same range of columns; ends are inclusive.
  HYPRE_IJMatrixCreate(
    team.communicator(), rows.begin, rows.end - 1, rows.begin, rows.end - 1, &this->Self.object);
  HYPRE_IJMatrixSetObjectType(this->Self, HYPRE_PARCSR);
  HYPRE_IJMatrixSetRowSizes(this->Self, sizes.data());
  checkHypre(HYPRE_IJMatrixInitialize(this->Self), "begin a matrix");
}

/** Entries for rows of other processes are sent to them by assemble(). */
void HypreMatrix::add(
  HYPRE_BigInt row, std::span<const HYPRE_BigInt> columns, std::span<const double> values)
{
  auto count = static_cast<HYPRE_Int>(columns.size());
  checkHypre(HYPRE_IJMatrixAddToValues(this->Self, 1, &count, &row, columns.data(), values.data()),
    "add to a matrix");
}

void HypreMatrix::assemble()
{
  this->Processes.agree();
  checkHypre(HYPRE_IJMatrixAssemble(this->Self), "assemble a matrix");
  void* object = nullptr;
  checkHypre(HYPRE_IJMatrixGetObject(this->Self, &object), "assemble a matrix");
  this->Parallel = static_cast<HYPRE_ParCSRMatrix>(object);
}

HypreVector::HypreVector(Team& team, const HypreRows& rows)
  : Numbers(static_cast<std::size_t>(rows.count()))
{
  // hypre takes values with the numbers of their rows.
  std::iota(this->Numbers.begin(), this->Numbers.end(), rows.begin);
  team.agree();
  HYPRE_IJVectorCreate(team.communicator(), rows.begin, rows.end - 1, &this->Self.object);
  HYPRE_IJVectorSetObjectType(this->Self, HYPRE_PARCSR);
  HYPRE_IJVectorInitialize(this->Self);
  checkHypre(HYPRE_IJVectorAssemble(this->Self), "make a vector");
  void* object = nullptr;
  checkHypre(HYPRE_IJVectorGetObject(this->Self, &object), "make a vector");
  this->Parallel = static_cast<HYPRE_ParVector>(object);
}

void HypreVector::set(std::span<const double> values)
{
  checkHypre(HYPRE_IJVectorSetValues(this->Self, static_cast<HYPRE_Int>(this->Numbers.size()),
               this->Numbers.data(), values.data()),
    "set a vector");
}

void HypreVector::get(std::span<double> values) const
{
  checkHypre(HYPRE_IJVectorGetValues(this->Self, static_cast<HYPRE_Int>(this->Numbers.size()),
               this->Numbers.data(), values.data()),
    "read a vector");
}

BoomerAmg::BoomerAmg(const HypreMatrix& matrix, const HypreVector& b, const HypreVector& x)
  : Matrix(matrix)
{
  HYPRE_BoomerAMGCreate(&this->Self.object);
  // As a preconditioner: one V-cycle from zero, whatever the residual.
  HYPRE_BoomerAMGSetTol(this->Self, 0.0);
  HYPRE_BoomerAMGSetMaxIter(this->Self, 1);
  HYPRE_BoomerAMGSetPrintLevel(this->Self, 0);
  // Symmetric Gauss-Seidel with the l1 norms of couplings to other processes in the diagonal: it
  // converges for any number of processes (Baker, Falgout, Kolev and Yang 2011) and is symmetric,
  // as conjugate gradients require.
  HYPRE_BoomerAMGSetRelaxType(this->Self, 8);
  checkHypre(HYPRE_BoomerAMGSetup(this->Self, matrix.parallel(), b.parallel(), x.parallel()),
    "set up BoomerAMG");
}

void BoomerAmg::apply(const HypreVector& b, HypreVector& x) const
{
  // A preconditioner is linear: it begins with zero each time.
  HYPRE_ParVectorSetConstantValues(x.parallel(), 0.0);
  HYPRE_BoomerAMGSolve(this->Self, this->Matrix.parallel(), b.parallel(), x.parallel());
  // One cycle does not reach a tolerance, which hypre may report as an error.
  HYPRE_ClearAllErrors();
}

} // namespace smg
