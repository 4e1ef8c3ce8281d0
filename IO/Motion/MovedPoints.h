// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Solve.h"
#include "Solver/Stream/MeshSource.h"

#include <memory>

namespace smg
{

/**
 * A mesh stream with its vertices where a solution of three columns says, rounded to the precision
 * of the stream. The bounds of its info are not known.
 */
class MovedPoints : public MeshSource
{
public:
  /** The positions must live as long as this. */
  MovedPoints(std::unique_ptr<MeshSource> source, Solution& positions);

  const StreamInfo& info() const override { return this->Info; }

  /** Throws Error if a position is not finite in the stream's precision. */
  bool next(MeshBlock& block) override;

private:
  std::unique_ptr<MeshSource> Source;
  StreamInfo Info;
  Solution& Positions;
};

} // namespace smg
