// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Vtk/PieceStream.h"

#include <filesystem>
#include <string>

class vtkAlgorithm;
class vtkRegionFilter;

namespace smg
{

/** The first of a chain of regions that ends at `region`. Its input has the points of the whole
 * chain, without the arrays that the regions add. */
vtkAlgorithm& firstOfChain(vtkRegionFilter& region);

/** Throws Error if a filter before this one joins meshes some of which have conditions: of arrays
 * and texts with the same names it keeps the first, so that conditions would be mistaken for one
 * another. */
void requireConditionsAfterJoins(vtkAlgorithm& filter);

/** A .vsm file and what it must have: StoredMesh::fileFingerprint(); empty: anything. */
struct StreamFile
{
  std::filesystem::path path;
  std::string fingerprint;
};

/**
 * The .vsm file of the reader before a filter, if its pieces reach the filter unchanged with these
 * columns: between the two there are only conditions, which then have no arrays of their own that
 * count, or none if all columns are wanted. An empty path: there is none, or the file has been
 * replaced since it was opened.
 */
StreamFile unchangedFile(vtkAlgorithm& filter, const PieceColumns& columns);

} // namespace smg
