// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Deformation/RestShape.h"
#include "Solver/Multigrid/Engine/StreamedSolution.h"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace smg
{

/** The result of a deformation: displacements and their start. */
class DeformedPositions final : public Solution
{
public:
  /** `rest` and the displacements use the same pool of memory. */
  DeformedPositions(std::unique_ptr<StreamedSolution> displacements, RestShape rest)
    : Displacements(std::move(displacements))
    , Rest(std::move(rest))
  {
  }

  std::int64_t vertices() const override { return this->Displacements->vertices(); }
  int columns() const override { return this->Displacements->columns(); }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    this->Displacements->read(first, count, values);
    this->Rest.addStart(first, count, values.data());
  }
  void removeCheckpoint() override { this->Displacements->removeCheckpoint(); }
  const Report& report() const override { return this->Displacements->report(); }

private:
  std::unique_ptr<StreamedSolution> Displacements;
  RestShape Rest;
};

} // namespace smg
