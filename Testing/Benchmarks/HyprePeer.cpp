// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/AssembledTask.h"
#include "Testing/Benchmarks/Usage.h"
#include "smg/Error.h"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>
#include <mpi.h>

#include <string>
#include <utility>
#include <vector>

namespace smg::benchmark
{
namespace
{

/** Throws if a call of hypre returns an error. */
void check(HYPRE_Int error, const char* what)
{
  if (error != 0)
  {
    throw Error(std::string("hypre failed: ") + what + ", error " + std::to_string(error) + ".");
  }
}

/** MPI and hypre, from first to last use. */
class Library
{
public:
  Library()
  {
    MPI_Init(nullptr, nullptr);
    HYPRE_Init();
  }
  ~Library()
  {
    HYPRE_Finalize();
    MPI_Finalize();
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

/** A vector of hypre's on one process. */
class Vector
{
public:
  explicit Vector(std::vector<HYPRE_BigInt> rows)
    : Rows(std::move(rows))
  {
    const auto count = static_cast<HYPRE_BigInt>(this->Rows.size());
    HYPRE_IJVectorCreate(MPI_COMM_SELF, 0, count - 1, &this->Self);
    HYPRE_IJVectorSetObjectType(this->Self, HYPRE_PARCSR);
  }
  ~Vector() { HYPRE_IJVectorDestroy(this->Self); }
  Vector(const Vector&) = delete;
  Vector& operator=(const Vector&) = delete;

  void set(const double* values)
  {
    const auto count = static_cast<HYPRE_Int>(this->Rows.size());
    check(HYPRE_IJVectorInitialize(this->Self), "a vector");
    check(HYPRE_IJVectorSetValues(this->Self, count, this->Rows.data(), values), "a vector");
    check(HYPRE_IJVectorAssemble(this->Self), "a vector");
  }
  void get(double* values)
  {
    const auto count = static_cast<HYPRE_Int>(this->Rows.size());
    check(HYPRE_IJVectorGetValues(this->Self, count, this->Rows.data(), values), "a vector");
  }
  HYPRE_ParVector parallel()
  {
    void* object = nullptr;
    check(HYPRE_IJVectorGetObject(this->Self, &object), "a vector");
    return static_cast<HYPRE_ParVector>(object);
  }

private:
  std::vector<HYPRE_BigInt> Rows;
  HYPRE_IJVector Self = nullptr;
};

/** A matrix of hypre's from a symmetric one of Eigen's: its columns are its rows. */
class Matrix
{
public:
  explicit Matrix(const Eigen::SparseMatrix<double>& matrix)
  {
    const auto count = static_cast<HYPRE_BigInt>(matrix.rows());
    HYPRE_IJMatrixCreate(MPI_COMM_SELF, 0, count - 1, 0, count - 1, &this->Self);
    HYPRE_IJMatrixSetObjectType(this->Self, HYPRE_PARCSR);
    std::vector<HYPRE_Int> sizes(matrix.rows());
    for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    {
      sizes[row] = matrix.outerIndexPtr()[row + 1] - matrix.outerIndexPtr()[row];
    }
    check(HYPRE_IJMatrixSetRowSizes(this->Self, sizes.data()), "the matrix");
    check(HYPRE_IJMatrixInitialize(this->Self), "the matrix");
    std::vector<HYPRE_BigInt> columns;
    for (HYPRE_BigInt row = 0; row < count; ++row)
    {
      const auto first = matrix.outerIndexPtr()[row];
      columns.assign(matrix.innerIndexPtr() + first, matrix.innerIndexPtr() + first + sizes[row]);
      check(HYPRE_IJMatrixSetValues(
              this->Self, 1, &sizes[row], &row, columns.data(), matrix.valuePtr() + first),
        "the matrix");
    }
    check(HYPRE_IJMatrixAssemble(this->Self), "the matrix");
  }
  ~Matrix() { HYPRE_IJMatrixDestroy(this->Self); }
  Matrix(const Matrix&) = delete;
  Matrix& operator=(const Matrix&) = delete;

  HYPRE_ParCSRMatrix parallel() const
  {
    void* object = nullptr;
    check(HYPRE_IJMatrixGetObject(this->Self, &object), "the matrix");
    return static_cast<HYPRE_ParCSRMatrix>(object);
  }

private:
  HYPRE_IJMatrix Self = nullptr;
};

/** Conjugate gradients preconditioned by one V-cycle of BoomerAMG with hypre's defaults. */
class Solver
{
public:
  /** `goal`: the norm of the residual to reach. */
  explicit Solver(double goal)
  {
    HYPRE_BoomerAMGCreate(&this->Amg);
    HYPRE_BoomerAMGSetTol(this->Amg, 0.0);
    HYPRE_BoomerAMGSetMaxIter(this->Amg, 1);
    HYPRE_BoomerAMGSetPrintLevel(this->Amg, 0);
    // Gauss-Seidel forward and backward: conjugate gradients need a symmetric cycle.
    HYPRE_BoomerAMGSetRelaxType(this->Amg, 6);

    HYPRE_ParCSRPCGCreate(MPI_COMM_SELF, &this->Pcg);
    HYPRE_PCGSetTol(this->Pcg, 0.0);
    HYPRE_PCGSetAbsoluteTol(this->Pcg, goal);
    HYPRE_PCGSetTwoNorm(this->Pcg, 1);
    HYPRE_PCGSetMaxIter(this->Pcg, 500);
    HYPRE_PCGSetPrecond(this->Pcg, reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSolve),
      reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSetup), this->Amg);
  }
  ~Solver()
  {
    HYPRE_ParCSRPCGDestroy(this->Pcg);
    HYPRE_BoomerAMGDestroy(this->Amg);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  void setUp(const Matrix& matrix, Vector& b, Vector& x)
  {
    check(HYPRE_ParCSRPCGSetup(this->Pcg, matrix.parallel(), b.parallel(), x.parallel()), "set-up");
  }
  /** Returns the number of iterations. */
  int solve(const Matrix& matrix, Vector& b, Vector& x)
  {
    check(HYPRE_ParCSRPCGSolve(this->Pcg, matrix.parallel(), b.parallel(), x.parallel()), "solve");
    HYPRE_Int iterations = 0;
    HYPRE_PCGGetNumIterations(this->Pcg, &iterations);
    return iterations;
  }

private:
  HYPRE_Solver Amg = nullptr;
  HYPRE_Solver Pcg = nullptr;
};

} // namespace

nlohmann::json runHypre(const Task& task)
{
  const Library library;
  CpuClock clock;
  testing::DirectSystem system = assemble(task);
  Eigen::MatrixXd x = system.initial();
  // The correction e of A e = b - A x_0, starting from zero.
  const Eigen::MatrixXd residual = system.rightSide - system.matrix * x;
  const double goal = goalOfColumns(task, system);
  const Matrix matrix(system.matrix);
  system.matrix = {};
  system.rightSide.resize(0, 0);
  std::vector<HYPRE_BigInt> rows(x.rows());
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    rows[i] = static_cast<HYPRE_BigInt>(i);
  }
  Vector b(rows);
  Vector e(rows);
  Eigen::VectorXd correction = Eigen::VectorXd::Zero(x.rows());
  b.set(residual.col(0).data());
  e.set(correction.data());
  const double assembling = clock.lap();
  resetPeak();

  clock.lap();
  Solver solver(goal);
  solver.setUp(matrix, b, e);
  const double setUp = clock.lap();
  int iterations = 0;
  for (Eigen::Index column = 0; column < x.cols(); ++column)
  {
    b.set(residual.col(column).data());
    correction.setZero();
    e.set(correction.data());
    iterations += solver.solve(matrix, b, e);
    e.get(correction.data());
    x.col(column) += correction;
  }
  const double solving = clock.lap();
  const std::int64_t peak = peakBytes();
  writeSolution(task, system.scatter(x));
  return { { "cpu_assemble", assembling }, { "cpu_setup", setUp }, { "cpu_solve", solving },
    { "cpu_total", assembling + setUp + solving }, { "peak_bytes", peak },
    { "iterations", iterations }, { "converged", true } };
}

} // namespace smg::benchmark
