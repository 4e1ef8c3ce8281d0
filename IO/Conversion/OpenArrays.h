// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/MeshArrays.h"
#include "smg/Convert.h"
#include "smg/Export.h"

#include <filesystem>
#include <memory>
#include <string>

namespace smg
{

/**
 * Opens a mesh of arrays: it is converted to a .vsm file in the scratch folder, and the arrays are
 * needed no longer.
 * @param points x, y, z of each vertex; of single precision if that is their type
 * @param cells three corners of each triangle or four of each tetrahedron: rows of `points`
 * @param options as for openMesh(), without those of files and without a checkpoint
 * @throws ArgumentError naming the array and its row; Error and Cancelled as convert()
 */
SMG_EXPORT std::unique_ptr<OpenedMesh> openArrays(
  const ArrayView& points, const ArrayView& cells, const ConversionOptions& options = {});

/**
 * Converts a mesh of arrays with cells of any type and attributes, as convert() does a file.
 * @param mesh what is converted; its columns are those of a .vtu file with these arrays
 * @param name what errors call it, as "The input"
 * @param out the result, as of convert()
 * @param options as for convert(), without those of files and without a checkpoint
 * @throws Error, naming the point or the cell; otherwise as convert()
 */
SMG_EXPORT ConversionReport convertArrays(const MeshArrays& mesh, const std::string& name,
  const std::filesystem::path& out, const ConversionOptions& options);

} // namespace smg
