// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/AssembledTask.h"
#include "Testing/Benchmarks/Usage.h"
#include "smg/Error.h"

#include <petscksp.h>

#include <string>
#include <type_traits>

namespace smg::benchmark
{
namespace
{

/** Throws if a call of PETSc returns an error. */
void check(PetscErrorCode error, const char* what)
{
  if (error != 0)
  {
    throw Error(std::string("PETSc failed: ") + what + ", error " + std::to_string(error) + ".");
  }
}

/** PETSc with its MPI, from first to last use. */
class Library
{
public:
  Library()
  {
    check(PetscInitializeNoArguments(), "its start");
    // This program reports the errors itself.
    PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  }
  ~Library() { PetscFinalize(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

/** A matrix of PETSc's on the arrays of a symmetric one of Eigen's: its columns are its rows. */
class Matrix
{
public:
  explicit Matrix(Eigen::SparseMatrix<double>& matrix)
  {
    static_assert(std::is_same_v<PetscInt, Eigen::SparseMatrix<double>::StorageIndex>);
    const auto size = static_cast<PetscInt>(matrix.rows());
    check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, size, size, matrix.outerIndexPtr(),
            matrix.innerIndexPtr(), matrix.valuePtr(), &this->Self),
      "the matrix");
    check(MatSetOption(this->Self, MAT_SPD, PETSC_TRUE), "the matrix");
  }
  ~Matrix() { MatDestroy(&this->Self); }
  Matrix(const Matrix&) = delete;
  Matrix& operator=(const Matrix&) = delete;

  Mat self() const { return this->Self; }

private:
  Mat Self = nullptr;
};

/** A vector of PETSc's on the values of one of Eigen's. */
class Vector
{
public:
  Vector(Eigen::Index size, const double* values)
  {
    check(
      VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(size), values, &this->Self),
      "a vector");
  }
  ~Vector() { VecDestroy(&this->Self); }
  Vector(const Vector&) = delete;
  Vector& operator=(const Vector&) = delete;

  Vec self() const { return this->Self; }

private:
  Vec Self = nullptr;
};

/** Conjugate gradients preconditioned by one V-cycle of GAMG with PETSc's defaults. */
class Solver
{
public:
  /** `goal`: the norm of the residual to reach. */
  Solver(const Matrix& matrix, double goal)
  {
    check(KSPCreate(PETSC_COMM_SELF, &this->Self), "the solver");
    KSPSetOperators(this->Self, matrix.self(), matrix.self());
    KSPSetType(this->Self, KSPCG);
    KSPSetNormType(this->Self, KSP_NORM_UNPRECONDITIONED);
    KSPSetTolerances(this->Self, 0.0, goal, PETSC_DEFAULT, 500);
    PC preconditioner = nullptr;
    KSPGetPC(this->Self, &preconditioner);
    check(PCSetType(preconditioner, PCGAMG), "the solver");
    check(KSPSetUp(this->Self), "set-up");
  }
  ~Solver() { KSPDestroy(&this->Self); }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  void solve(const Vector& b, const Vector& x)
  {
    check(KSPSolve(this->Self, b.self(), x.self()), "solve");
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    KSPGetConvergedReason(this->Self, &reason);
    KSPGetIterationNumber(this->Self, &iterations);
    this->Converged = this->Converged && reason > 0;
    this->Iterations += iterations;
  }

  /** Of all columns together. */
  int iterations() const { return this->Iterations; }
  bool converged() const { return this->Converged; }

private:
  KSP Self = nullptr;
  int Iterations = 0;
  bool Converged = true;
};

} // namespace

nlohmann::json runPetsc(const Task& task)
{
  const Library library;
  CpuClock clock;
  testing::DirectSystem system = assemble(task);
  Eigen::MatrixXd x = system.initial();
  // The correction e of A e = b - A x_0, starting from zero.
  const Eigen::MatrixXd residual = system.rightSide - system.matrix * x;
  const double goal = goalOfColumns(task, system);
  system.rightSide.resize(0, 0);
  const Matrix matrix(system.matrix);
  Eigen::VectorXd correction(x.rows());
  const double assembling = clock.lap();
  resetPeak();

  clock.lap();
  Solver solver(matrix, goal);
  const double setUp = clock.lap();
  for (Eigen::Index column = 0; column < x.cols(); ++column)
  {
    const Vector b(x.rows(), residual.col(column).data());
    const Vector e(x.rows(), correction.data());
    solver.solve(b, e);
    x.col(column) += correction;
  }
  const double solving = clock.lap();
  const std::int64_t peak = peakBytes();
  writeSolution(task, system.scatter(x));
  return { { "cpu_assemble", assembling }, { "cpu_setup", setUp }, { "cpu_solve", solving },
    { "cpu_total", assembling + setUp + solving }, { "peak_bytes", peak },
    { "iterations", solver.iterations() }, { "converged", solver.converged() } };
}

} // namespace smg::benchmark
