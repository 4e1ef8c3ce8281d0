// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/StreamedSystem.h"
#include "Solver/Multigrid/Engine/SystemRecords.h"
#include "smg/LinearSolver.h"
#include "smg/Solve.h"

#include <cstdint>
#include <span>
#include <string>

namespace smg
{

/** Columns of vectors that somebody gives and takes. */
struct LinearVectors
{
  std::int64_t columns; ///< of all vectors
  GivenVectors give;
  TakenVectors take;
};

/** The equations of a problem, solved for one right-hand side after the other: LinearSolver and
 * SystemOnDisk document what each function does. Of the first pass, rows, hierarchy and factor are
 * kept, in memory or on scratch files; x and b begin anew with each call. */
class LinearEngine
{
public:
  LinearEngine(CompiledOperators operators, int columns, const SolveOptions& options);

  LinearEngine(const LinearEngine&) = delete;
  LinearEngine& operator=(const LinearEngine&) = delete;

  /** The first pass; to be called once, before all others. */
  void build(MeshSource& mesh, Problem& problem);
  void solve(
    const LinearVectors& vectors, const Stopping& stopping, const ProgressFunction& progress);
  void solve(std::span<const double> b, std::span<double> x, const Stopping& stopping,
    const ProgressFunction& progress);
  // In core:
  void precondition(std::span<const double> r, std::span<double> z);
  void multiply(std::span<const double> x, std::span<double> y);

  std::int64_t vertices() const { return this->System.context().report.vertices; }
  int columns() const { return this->Columns; }
  const Report& report() const { return this->System.context().report; }

private:
  /** The columns of given vectors that are treated together. */
  struct Group
  {
    std::size_t first, count;
    std::size_t all; ///< the numbers of a vertex
    /** "column 2", or "columns 2 to 4". */
    std::string name() const;
  };

  std::size_t columnsOf(std::span<const double> in, std::span<const double> out) const;
  template <class F>
  void forGroups(std::size_t all, F&& f);
  void load(std::span<const double> values, const Group& group, const char* what, Ring<double>& to);
  void store(const Ring<double>& from, double factor, const Group& group, std::span<double> values);
  void solve(const Group& group, const LinearVectors& vectors, const Stopping& stopping);
  void take(const Group& group, const LinearVectors& vectors);
  void addKnown(LevelWindow<double>& window);

  int Columns;
  int VectorSize = 1;
  StreamedSystem System;
  SolveContext& Context; // of the system
  SystemRecords Records;
};

} // namespace smg
