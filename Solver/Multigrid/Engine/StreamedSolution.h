// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "Solver/Multigrid/Engine/SolveContext.h"
#include "smg/Export.h"
#include "smg/Solve.h"

#include <cstdint>
#include <memory>
#include <span>

namespace smg
{

/** The result of a solve: the values of the finest level, in a scratch file or in memory. */
class SMG_EXPORT StreamedSolution final : public Solution
{
public:
  /** `window` belongs to `run` and has only the solution. */
  StreamedSolution(std::unique_ptr<SolveContext> context, LevelWindow<double> window);

  std::int64_t vertices() const override { return this->Context->report.vertices; }
  int columns() const override { return this->Window.columns(); }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override;
  void removeCheckpoint() override;
  const Report& report() const override { return this->Context->report; }

private:
  std::unique_ptr<SolveContext> Context; // outlives the window, whose memory it accounts for
  LevelWindow<double> Window;
};

} // namespace smg
