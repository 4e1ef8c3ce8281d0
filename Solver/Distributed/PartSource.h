// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/DistributedSolver.h"

#include <utility>

namespace smg
{

/** The part of a mesh as a stream of one block, which may be empty. */
class PartSource final : public MeshSource
{
public:
  explicit PartSource(const MeshPart& part)
    : Part(part)
  {
  }

  const StreamInfo& info() const override { return this->Part.info; }
  bool next(MeshBlock& block) override
  {
    if (std::exchange(this->Read, true))
    {
      return false;
    }
    block = this->Part.block;
    return true;
  }

private:
  const MeshPart& Part;
  bool Read = false;
};

} // namespace smg
