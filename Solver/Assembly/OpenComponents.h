// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/ComponentLabels.h"
#include "Solver/Assembly/Components.h"
#include "Solver/Memory/Ring.h"
#include "smg/Export.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** The components of open vertices, according to the cells so far. */
class SMG_EXPORT OpenComponents
{
public:
  /** `labels` receives the component of each closed vertex. */
  OpenComponents(Pool& pool, Components& components, ComponentLabels& labels)
    : Parts(components)
    , Closed(labels)
    , Labels(pool)
  {
  }

  /** Sets the number of vertices so far; new ones have no component. */
  void extend(std::int64_t vertices);
  void release(std::int64_t first) { this->Labels.release(first); }
  /** Joins the corners of a cell. */
  void join(const std::int64_t* corners, int count)
  {
    const std::int32_t label = this->Labels[corners[0]];
    bool joined = label >= 0;
    for (int k = 1; k < count; ++k)
    {
      joined = joined && this->Labels[corners[k]] == label;
    }
    if (!joined)
    {
      this->joinOthers(corners, count);
    }
  }
  /** A label of the component of an open vertex, which depends on its cells and those before them
   * only; -1: none. */
  std::int32_t label(std::int64_t i) const { return this->Labels[i]; }
  /** Closes vertex i, the next one, with this mass; returns the root of its component, or -1. */
  std::int32_t close(std::int64_t i, double mass);
  /** The same of a vertex that nothing determines. */
  std::int32_t closeUndetermined(std::int64_t i);
  /** Passes on the closed vertices. */
  void flush();

private:
  void joinOthers(const std::int64_t* corners, int count);

  Components& Parts;
  ComponentLabels& Closed;
  Ring<std::int32_t> Labels; // of the first component of a vertex, or -1
  std::vector<std::int32_t> LabelBatch;
  std::vector<double> MassBatch;
};

} // namespace smg
