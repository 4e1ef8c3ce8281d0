// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"

#include <filesystem>

namespace smg::testing
{

// Check that an accepted file is what its header promises. Throw Finding.

/** Counts agree, positions are finite, corners are vertices, columns have all tuples. */
void checkMesh(const RawMesh& mesh);

/** Reads a streaming mesh file element by element: positions are finite, the indices of a pre-order
 * file name known vertices, the counts are those of the header. Throws Error. */
void checkStreamFile(const std::filesystem::path& path);

/** Reads a .vsm file as a stream, which must be compact and have the counts of its header, and in
 * pieces, forwards and backwards, which must be the same; then single columns, last cells, isolated
 * vertices and all checksums. Throws Error. */
void checkVsm(const std::filesystem::path& path);

/** Describes a .vsm file and brings it into other formats, another order and fewer triangles, in
 * the least memory, with files in `folder`. Throws Error. */
void checkConversions(const std::filesystem::path& path, const std::filesystem::path& folder);

} // namespace smg::testing
