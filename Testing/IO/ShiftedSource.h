// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstddef>
#include <memory>
#include <utility>

namespace smg::testing
{

/** A mesh stream moved by `shift` along x. */
class ShiftedSource : public MeshSource
{
public:
  ShiftedSource(std::unique_ptr<MeshSource> source, double shift)
    : Source(std::move(source))
    , Shift(shift)
  {
  }

  const StreamInfo& info() const override { return this->Source->info(); }

  bool next(MeshBlock& block) override
  {
    if (!this->Source->next(block))
    {
      return false;
    }
    for (std::size_t i = 0; i < block.positions.size(); i += 3)
    {
      block.positions[i] += this->Shift;
    }
    return true;
  }

private:
  std::unique_ptr<MeshSource> Source;
  double Shift;
};

} // namespace smg::testing
