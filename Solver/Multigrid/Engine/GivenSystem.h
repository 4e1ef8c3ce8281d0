// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/RowAssembly.h"
#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "Solver/Multigrid/Engine/ColumnScales.h"
#include "Solver/Multigrid/Engine/Hierarchy.h"
#include "Solver/Multigrid/Engine/NextSystem.h"
#include "Solver/Multigrid/Engine/SolveContext.h"
#include "Solver/Multigrid/Engine/SystemRecords.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Gives right-hand sides and initial values, vertex by vertex. */
class SystemValues
{
public:
  virtual ~SystemValues() = default;

  /**
   * Sets b and x of the vertices [first, first + count) of the block of `record`; called in
   * ascending order. A value per vertex and column, without padding.
   * @param before the final values of the system before; b of known vertices in it
   * @param x the initial values; as `before` when it is called
   * @param b the loads of unknowns, without those of known neighbours; the values of known vertices
   */
  virtual void give(const SystemRecord& record, std::int64_t first, std::int64_t count,
    std::span<const double> before, std::span<double> x, std::span<double> b) = 0;
};

/**
 * A system whose b and x depend on the vertex alone, as those of a step in time do, or of vectors
 * that somebody gives. Adds the known neighbours to b, and sums up the residual of the initial
 * values as a first pass does: b, x, sums, and so the solution, are those of a problem that is
 * assembled anew, to the last bit.
 */
class SMG_EXPORT GivenSystem final : public NextSystem
{
public:
  /** `columns`: those of the system before, unless it is given up. */
  GivenSystem(SolveContext& context, SystemRecords& records, LevelWindow<double>& window,
    SystemValues& values, int columns, double scale = 0.0);

  int columns() const override { return this->Columns; }
  double scale() const override { return this->Scale; }
  void startPass() override;
  void load() override;
  std::int64_t taken() const override { return this->Taken; }
  std::int64_t fill(std::int64_t final) override;
  void endPass() override;

  // After the pass:

  /** The residual of the initial values, whose right-hand side gets a mean of 0 where a component
   * is free: see FirstPass. */
  ColumnResiduals residual(Hierarchy& hierarchy);
  /** ||b - A x|| of the final values of the system before, with these scales of columns. */
  double normBefore(const ColumnScales& scales) const;
  /** The means of these final values in components that are held loosely, by which V-cycles do not
   * determine them: per column and label, label-major; empty if there is no such component. */
  std::vector<double> meansBefore() const;

private:
  /** Whether the values before are not given up. */
  bool hasBefore() const { return this->Window.isSeparate(); }
  void take(std::int64_t end);
  void closeRows(std::int64_t end);
  template <class Arrays>
  void addRows(const Arrays& rows, const BlockPart<double>& part);
  template <class Arrays>
  void addRow(
    const RowBlock::Header& h, const Arrays& arrays, const BlockPart<double>& part, std::int64_t k);
  void addMeanBefore(std::int32_t root, std::int64_t vertex, double weight);
  template <class Arrays>
  void addResidualBefore(const RowBlock::Header& h, const Arrays& arrays, std::int64_t k);

  SolveContext& Context;
  LevelWindow<double>& Window;
  SystemValues& Values;
  int Columns;
  double Scale;
  OpenRecords Records;
  std::int64_t Taken = 0, Closed = 0, Complete = 0;
  // In the record of Closed.
  std::size_t NextLink = 0, NextKnown = 0, Run = 0;
  InitialResidual First;
  std::vector<double> SquaresBefore, OfRow;
  std::vector<double> SumsBefore, WeightsBefore; // of components that are held loosely
  std::vector<double> Before, X, B;              // of the vertices that are taken
};

} // namespace smg
