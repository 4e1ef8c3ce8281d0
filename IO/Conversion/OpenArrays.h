// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/ArrayView.h"
#include "smg/Convert.h"
#include "smg/Export.h"

#include <memory>

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

} // namespace smg
