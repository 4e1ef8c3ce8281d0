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

/** The memory in bytes of a plan made by `threads` threads, not counting the searches. */
std::int64_t searchPlanMemory(const PagedMesh& mesh, int landmarks, int threads, int helpers = 0);

/**
 * Plans the search of a large component. Distances are measured from a few landmarks, which are far
 * from each other, and from the ends of the principal axes. Sources, and the levels at which they
 * begin, are chosen among these so that the search has a small span and width. The plan is tried
 * out: no single source from which distances were measured has a search of less cost, see
 * searchCost(). Deterministic.
 * @param search of the pages of the mesh; its last search was of this component
 * @param landmarks at least 2 are used
 * @param end a vertex far out in the component, such as the last one of a search
 * @param helpers the number of further searches at the same time, if the cache has all pages; the
 * result does not depend on it
 * @return sources in ascending order of levels
 */
std::vector<SearchSource> planSearch(PagedSearch& search, const PagedMesh& mesh,
  Workspace& workspace, int landmarks, std::uint32_t end, int helpers = 0);

} // namespace smg
