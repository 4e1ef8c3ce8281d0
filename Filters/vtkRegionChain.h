// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <set>
#include <string>

class vtkAlgorithm;
class vtkRegionFilter;

namespace smg
{

/** The first of a chain of regions that ends at `region`. Its input has the points of the whole
 * chain, without the arrays that the regions add. */
vtkAlgorithm& firstOfChain(vtkRegionFilter& region);

/**
 * The .vsm file of the reader before a filter, if its pieces reach the filter unchanged and have
 * the arrays `names`: between the two there are only conditions, which then have no arrays of their
 * own that count. Empty: there is none.
 */
std::filesystem::path unchangedFile(vtkAlgorithm& filter, const std::set<std::string>& names);

} // namespace smg
