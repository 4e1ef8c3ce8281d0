// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Assembly.h"
#include "Solver/Shi2006/Level.h"

namespace smg::shi2006
{

/** Builds the finest level from the final rows of an Assembly and from the edge targets. */
class FinestRows : public RowListener
{
public:
  /** The components and labels are for the assembly; `level` must be empty. */
  FinestRows(Pool& pool, const StreamInfo& info, Problem& problem, Components& components,
    ComponentLabels& labels, Level& level);

  void add(const MeshBlock& block);
  /** Finishes the remaining rows. The level is then complete except for `rightSide`: see
   * sumRightSide(). */
  void finish();
  const Assembly& assembly() const { return this->Assembled; }

  // Notifications of the assembly.
  void link(std::int32_t /*delta*/, float /*weight*/) override {} // contained in alpha and xi0
  void target(const double* target) override;
  void constraint(const double* sum) override;
  void close(const double* /*point*/, std::int64_t /*reach*/) override {}

private:
  void take();

  Level& Finest;
  AssembledRows Made;
  LevelRows Rows;
  ResidentNodes Resident;
  LevelWindow<double> State;
  Assembly Assembled;
};

} // namespace smg::shi2006
