// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"
#include "smg/Report.h"

#include <gtest/gtest.h>

#include <vector>

namespace smg::testing
{

/** Checks that memory, in the reports of `run` for the meshes, grows by at most the factors `nodes`
 * and `bytes` from each mesh to the next. */
template <class Run>
void expectGrowth(Run run, const std::vector<StreamMesh>& meshes, double nodes, double bytes)
{
  Report before;
  for (const StreamMesh& mesh : meshes)
  {
    const Report report = run(mesh);
    if (before.vertices > 0)
    {
      EXPECT_LE(
        static_cast<double>(report.peak_nodes), nodes * static_cast<double>(before.peak_nodes))
        << mesh.vertices() << " vertices";
      EXPECT_LE(static_cast<double>(report.pool_bytes_peak),
        bytes * static_cast<double>(before.pool_bytes_peak))
        << mesh.vertices() << " vertices";
    }
    before = report;
  }
}

} // namespace smg::testing
