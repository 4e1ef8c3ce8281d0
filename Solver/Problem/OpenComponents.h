// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/ComponentLabels.h"
#include "Solver/Problem/Components.h"
#include "Solver/Storage/Ring.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** The components that open vertices belong to, as far as their cells have come. */
class OpenComponents
{
public:
  /** `labels` is told the component of each vertex that is closed. */
  OpenComponents(Pool& pool, Components& components, ComponentLabels& labels)
    : Parts(components)
    , Closed(labels)
    , Labels(pool)
  {
  }

  /** As many vertices have come; the further ones are alone. */
  void extend(std::int64_t vertices);
  void release(std::int64_t first) { this->Labels.release(first); }
  /** The corners of a cell belong together. */
  void join(const std::int64_t* corners, int count);
  /** The component of vertex i, the next one to be closed, or -1; `mass`: what it weighs. */
  std::int32_t close(std::int64_t i, double mass);
  /** Passes on what has been closed. */
  void flush();

private:
  Components& Parts;
  ComponentLabels& Closed;
  Ring<std::int32_t> Labels; // of the first component that a vertex belonged to, or -1
  std::vector<std::int32_t> LabelBatch;
  std::vector<double> MassBatch;
};

} // namespace smg
