// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Pages/PageBuilder.h"
#include "IO/Order/Search/PagedSearch.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** The most searches besides the first one that a plan can make at once. */
inline constexpr int MaxSearchHelpers = 4;

/** The memory of a plan in bytes, if it is made by so many threads, without that of searches. */
std::int64_t searchPlanMemory(const PagedMesh& mesh, int landmarks, int threads, int helpers = 0);

/**
 * Plans the search of a large component. Distances are measured from a few landmarks, which are far
 * from each other, and from the ends of the principal axes; sources, and the levels at which they
 * begin, are chosen among these such that the search has a small span and width. The plan is tried
 * out: no single source that distances were measured from has a search of less cost, see
 * searchCost. Deterministic.
 * @param search of the pages of the mesh; it has searched the component last
 * @param landmarks less than 2 are taken for 2
 * @param end a vertex of the component that is far out, such as the last one of a search
 * @param helpers the number of further searches at the same time, if the cache has all pages; the
 * result does not depend on it
 * @return sources in ascending order of levels
 */
std::vector<SearchSource> planSearch(PagedSearch& search, const PagedMesh& mesh,
  Workspace& workspace, int landmarks, std::uint32_t end, int helpers = 0);

} // namespace smg
