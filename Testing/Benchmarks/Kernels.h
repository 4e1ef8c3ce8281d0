// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"
#include "smg/Report.h"

#include <benchmark/benchmark.h>

#include <cstdint>

namespace smg::benchmark
{

/** Levels with fewer nodes take a negligible part of a solve and are not measured. */
inline constexpr std::int64_t FewestNodes = 5000;

/** Converts `seconds` of all iterations to nanoseconds per node of the level. All times here are
 * processor times, because the machine may be shared. */
inline double perNode(double seconds, const ::benchmark::State& state, const Report::Level& level)
{
  return 1e9 * seconds /
         (static_cast<double>(level.nodes) * static_cast<double>(state.iterations()));
}

/** Sets the counters that all kernels have; `seconds` is the time of all iterations. */
inline void setCounters(::benchmark::State& state, const Report::Level& level, double seconds)
{
  state.counters["nodes"] = static_cast<double>(level.nodes);
  state.counters["nonzeros"] =
    static_cast<double>(level.nonzeros) / static_cast<double>(level.nodes);
  state.counters["ns_per_node"] = perNode(seconds, state, level);
}

/** Registers the kernels of a V-cycle, on the levels of the mesh in core. */
void addCycleKernels(const testing::StreamMesh& mesh);

/** Registers assembly and coarsening. The mesh is used when they run. */
void addBuildKernels(const testing::StreamMesh& mesh);

} // namespace smg::benchmark
